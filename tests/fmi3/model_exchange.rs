//! Model exchange (FMI 3.0, section 3): counts, lists and variables say the same, and its Jacobian is of differences.

use crate::two::Resources;
use brinell_fmi::fmi3::*;
use std::ffi::CString;
use std::{fs, ptr};

/// An instance in continuous-time mode; it is freed with the test.
struct Host(Instance);

impl Host {
    fn new(resources: &Resources) -> Self {
        let path = resources.directory.to_str().unwrap().to_owned() + "/";
        let [name, token, path] = ["integrated", &resources.guid, &path].map(|text| CString::new(text).unwrap());
        // SAFETY: strings that end in NUL; there is no logger.
        let instance = unsafe {
            fmi3InstantiateModelExchange(
                name.as_ptr(),
                token.as_ptr(),
                path.as_ptr(),
                FALSE,
                FALSE,
                ptr::null_mut(),
                None,
            )
        };
        Self(instance)
    }

    fn start(&self) {
        // SAFETY: any handle may be passed.
        unsafe {
            assert_eq!(fmi3EnterInitializationMode(self.0, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            assert_eq!(fmi3ExitInitializationMode(self.0), Status::Ok);
            let (mut flags, mut time) = ([TRUE; 5], 1.0);
            let [a, b, c, d, e] = &mut flags;
            assert_eq!(fmi3UpdateDiscreteStates(self.0, a, b, c, d, e, &raw mut time), Status::Ok);
            assert_eq!(flags, [FALSE; 5]);
            assert_eq!(fmi3EnterContinuousTimeMode(self.0), Status::Ok);
        }
    }

    fn list(&self, count: usize, get: unsafe extern "C" fn(Instance, *mut f64, usize) -> Status) -> Vec<f64> {
        let mut values = vec![f64::NAN; count];
        // SAFETY: as long as said.
        assert_eq!(unsafe { get(self.0, values.as_mut_ptr(), count) }, Status::Ok);
        values
    }

    fn get(&self, references: &[u32]) -> Vec<f64> {
        let (mut values, count) = (vec![f64::NAN; references.len()], references.len());
        // SAFETY: as long as said.
        let status = unsafe { fmi3GetFloat64(self.0, references.as_ptr(), count, values.as_mut_ptr(), count) };
        assert_eq!(status, Status::Ok);
        values
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: any handle may be passed.
        unsafe { fmi3FreeInstance(self.0) };
    }
}

#[test]
fn states_derivatives_and_indicators_are_variables_and_the_jacobian_is_theirs() {
    let resources = Resources::of("er16k-tb1");
    fs::write(resources.directory.join("interface"), "model-exchange").unwrap();
    let host = Host::new(&resources);
    host.start();
    let (mut states, mut indicators) = (0, 0);
    // SAFETY: the numbers may be written.
    unsafe {
        assert_eq!(fmi3GetNumberOfContinuousStates(host.0, &raw mut states), Status::Ok);
        assert_eq!(fmi3GetNumberOfEventIndicators(host.0, &raw mut indicators), Status::Ok);
    }
    let text = fs::read_to_string(resources.directory.join("scene.toml")).unwrap();
    let simulation = brinell::simulation::Simulation::new(brinell_scene_file::from_toml(&text).unwrap(), None).unwrap();
    let first = simulation.exchange_variables()[0].reference;
    let references = |from: usize, count: usize| (0..count).map(|i| first + (from + i) as u32).collect::<Vec<_>>();
    assert_eq!(host.get(&references(0, states)), host.list(states, fmi3GetContinuousStates));
    assert_eq!(host.get(&references(states, states)), host.list(states, fmi3GetContinuousStateDerivatives));
    assert_eq!(host.get(&references(2 * states, indicators)), host.list(indicators, fmi3GetEventIndicators));
    // The acceleration of the shaft by its own velocity: its support's damper, and what the contacts' hand on.
    let (unknown, known, seed) = ([first + (states + 21) as u32], [first + 21], [1.0]);
    let mut column = [f64::NAN];
    // SAFETY: as long as said.
    let status = unsafe {
        let (u, k) = (unknown.as_ptr(), known.as_ptr());
        fmi3GetDirectionalDerivative(host.0, u, 1, k, 1, seed.as_ptr(), 1, column.as_mut_ptr(), 1)
    };
    assert_eq!(status, Status::Ok);
    let here = host.list(states, fmi3GetContinuousStates);
    let slope = |by: f64| {
        let mut moved = here.clone();
        moved[21] += by;
        // SAFETY: as long as said.
        assert_eq!(unsafe { fmi3SetContinuousStates(host.0, moved.as_ptr(), states) }, Status::Ok);
        host.list(states, fmi3GetContinuousStateDerivatives)[21]
    };
    let difference = (slope(1e-6) - slope(-1e-6)) / 2e-6;
    // Contacts damp in proportion to their rate of approach, so that the difference has no error but rounding.
    assert!((column[0] / difference - 1.0).abs() < 1e-6, "{} and {difference}", column[0]);
}

#[test]
fn without_the_mark_of_its_kind_there_is_no_instance_for_model_exchange() {
    assert!(Host::new(&Resources::of("er16k-tb1")).0.is_null());
}
