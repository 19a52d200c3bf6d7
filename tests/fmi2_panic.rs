//! A panic inside the compiled library. In a program of its own, for what prints the panic may keep the library mapped.
//!
//! `unsafe` is what loading a library takes.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

#[path = "fmi2/library.rs"]
#[allow(dead_code)]
mod library;

use brinell_fmi::fmi2::*;
use libloading::Library;
use library::{Api, Scene, library};

#[test]
fn a_panic_in_the_library_reaches_the_host_as_a_status() {
    let scene = Scene::new("panic");
    // SAFETY: the library runs no code when it is loaded; its handles may be passed in any order.
    unsafe {
        let library = Library::new(library()).unwrap();
        let api = Api::of(&library);
        let (bad, good) = (api.start(c"panic on demand", &scene), api.start(c"good", &scene));
        assert_eq!((api.step)(bad, 0.0, 1e-5, TRUE), Status::Error);
        assert_eq!((api.step)(good, 0.0, 1e-5, TRUE), Status::Ok);
        (api.free)(bad);
        assert_eq!((api.step)(good, 1e-5, 1e-5, TRUE), Status::Ok);
        (api.free)(good);
    }
}
