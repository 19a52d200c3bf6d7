//! The exported functions of FMI 2.0, grouped as the standard groups them.

mod both_versions;
mod derivatives;
mod life;
mod model_exchange;
mod step;
mod variables;

pub use both_versions::*;
pub use derivatives::*;
pub use life::*;
pub use model_exchange::*;
pub use step::*;
pub use variables::*;

use super::{functions, types};
