//! The exported functions of FMI 3.0, grouped as the standard groups them.

mod both_versions;
mod dependencies;
mod derivatives;
mod life;
mod model_exchange;
mod not_provided;
mod step;
mod variables;

pub use both_versions::*;
pub use dependencies::*;
pub use derivatives::*;
pub use life::*;
pub use model_exchange::*;
pub use not_provided::*;
pub use step::*;
pub use variables::*;

use super::{functions, types, values};
