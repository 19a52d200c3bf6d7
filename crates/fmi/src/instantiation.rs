//! How an instance comes to be, or why it does not: the host gets NULL and its logger a line.

use std::ffi::{CStr, CString, c_char};
use std::ptr;

use crate::c_interface::{Component, Logger, Status, UriError};
use crate::instance::{Instance, handles};
use crate::resources::{ResourceError, SharedModel};
use crate::{boundary, resources};
use libc::c_int;
use std::path::{Path, PathBuf};

/// Why there is no instance.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refusal {
    #[error("the instance name is NULL or blank: give each instance a name")]
    Name,
    #[error("FMU type {0}: only co-simulation (1) is provided; `brinell build --kind both` makes an FMU for both")]
    Type(c_int),
    #[error("the {0} is NULL: pass the one of modelDescription.xml")]
    NoToken(&'static str),
    #[error(
        "{what} {given}: the resources have {own}. Model description, resources and binary must come from one FMU, \
         unpacked as it was built"
    )]
    Token { what: &'static str, given: String, own: String },
    #[error("the {0}")]
    NoResources(&'static str),
    #[error(transparent)]
    Resources(#[from] ResourceError),
    #[error("this FMU {0}")]
    NotProvided(&'static str),
    #[error("argument {0} is NULL or not aligned, and {1} elements are announced")]
    Array(&'static str, usize),
    #[error(
        "requiredIntermediateVariables: value reference {0} is none of a variable with intermediateUpdate=\"true\""
    )]
    NotIntermediate(u32),
    #[error("requiredIntermediateVariables without a callback intermediateUpdate: pass both or none")]
    NoCallback,
    #[error("too many instances are alive: free some")]
    TooMany,
    #[error("internal error: {0}. Please report it")]
    Panic(String),
}

impl From<UriError> for Refusal {
    fn from(error: UriError) -> Self {
        Self::Resources(error.into())
    }
}

/// Makes an instance. `logger` makes its logger of its name, or tells that there can be none; `prepare` reads its
/// model, and `arrange` adds what a version of the standard needs.
pub(crate) fn instantiate(
    function: &'static str,
    name: Option<&CStr>,
    logger: impl Fn(CString) -> Option<Logger>,
    prepare: impl FnOnce() -> Result<SharedModel, Refusal>,
    arrange: impl FnOnce(&mut Instance) -> Result<(), Refusal>,
) -> Component {
    let refuse = |logger: &Logger, refusal| logger.insist(Status::Error, format!("{function}: {refusal}."));
    let outcome = boundary::guard(|| {
        let name = name.filter(|name| !name.to_bytes().trim_ascii().is_empty());
        // The logger needs a name even to say that there is none.
        let logger = logger(name.unwrap_or(c"(unnamed)").to_owned())?;
        let model = match name.ok_or(Refusal::Name).and_then(|_| prepare()) {
            Ok(model) => model,
            Err(refusal) => {
                refuse(&logger, refusal);
                return None;
            }
        };
        let mut instance = Box::new(Instance::new(model, logger));
        if let Err(refusal) = arrange(&mut instance) {
            refuse(&instance.logger, refusal);
            return None;
        }
        instance.logger.line(Status::Ok, || format!("{function}: instantiated."));
        match handles::insert(instance) {
            Ok(component) => Some(component),
            Err(instance) => {
                refuse(&instance.logger, Refusal::TooMany);
                None
            }
        }
    });
    match outcome {
        Ok(component) => component.unwrap_or(ptr::null_mut()),
        Err(panic) => {
            drop(boundary::guard(|| {
                if let Some(logger) = logger(c"(unnamed)".to_owned()) {
                    refuse(&logger, Refusal::Panic(panic));
                }
            }));
            ptr::null_mut()
        }
    }
}

/// The model in a directory, if it is the one that the host's token, called `what`, names.
pub(crate) fn model(what: &'static str, token: &CStr, directory: PathBuf) -> Result<SharedModel, Refusal> {
    let model = resources::load(&directory)?;
    if token.to_bytes() != model.guid().as_bytes() {
        let (given, own) = (token.to_string_lossy().into_owned(), model.guid().to_owned());
        return Err(Refusal::Token { what, given, own });
    }
    Ok(model)
}

/// Whether the resources' file `interface`, which only what is unusual has, says so with this word.
pub(crate) fn is_marked(directory: &Path, word: &str) -> bool {
    let marks = std::fs::read_to_string(directory.join("interface"));
    marks.is_ok_and(|marks| marks.split_whitespace().any(|mark| mark == word))
}

/// Marks an FMU for model exchange.
pub(crate) const MODEL_EXCHANGE: &str = "model-exchange";
/// Marks an FMU of FMI 3.0 without arrays.
pub(crate) const SCALARS: &str = "scalars";

/// A string of the host's, if there is one.
///
/// # Safety
/// `pointer` is null or points to a string ended by NUL that outlives the call.
pub(crate) unsafe fn text<'a>(pointer: *const c_char) -> Option<&'a CStr> {
    // SAFETY: not null; the rest is the contract.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) })
}

/// Ends an instance: what its recorder still holds is stored, or its loss reported.
pub(crate) fn free(instance: handles::Borrowed, function: &'static str) {
    drop(boundary::guard(|| {
        let mut instance = handles::remove(instance);
        if let Err(failure) = instance.finish_recording("are lost") {
            instance.logger.tell(Status::Error, format!("{function}: {failure}."));
        }
    }));
}
