//! What C sees: its types, its logger, its addresses of files.

mod c_types;
mod logger;
pub(crate) mod uri;

pub use c_types::{
    AllocateMemoryCallback, Bool, CallbackFunctions, Component, ComponentEnvironment, FmiString, FmuState,
    FreeMemoryCallback, IntermediateUpdateCallback, LogMessageCallback, LoggerCallback, Status, StepFinishedCallback,
    ValueReference,
};

pub(crate) use logger::{Logger, c_string};
pub(crate) use uri::UriError;
