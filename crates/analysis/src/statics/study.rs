//! What every static study begins with: surfaces and maps, a model in equilibrium; and why it cannot be done.

use brinell::contact::map::ContactMaps;
use brinell::dynamics::contacts::Forces;
use brinell::dynamics::equilibrium::EquilibriumError;
use brinell::dynamics::parameters::{Cells, Excitation, Model};
use brinell::scene::{Scene, SceneError};
use brinell::simulation::SimulationError;
use brinell::simulation::setup::stored_map;
use brinell::surface::{Surface, SurfaceError};
use std::sync::Arc;

/// Why a static study cannot be done.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum StaticError {
    /// The scene is impossible.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The defect's profile cannot be used.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The scene cannot be set up.
    #[error(transparent)]
    SetUp(#[from] SimulationError),
    /// No balance was found.
    #[error("cage angle {cage_angle_deg} degrees, load {load:?} N: {cause}")]
    Equilibrium { cage_angle_deg: f64, load: [f64; 3], cause: EquilibriumError },
    /// Rings that move along the axis or tilt.
    #[error("bearing.degrees_of_freedom = {given}: this study is of rings in their plane, 2")]
    InSpace { given: usize },
    /// A study in space of rings in their plane.
    #[error("bearing.degrees_of_freedom = 2: this study is of rings in space, 3 or 5")]
    InThePlane,
    /// A shaft in space that no force moves.
    #[error(
        "bearing.degrees_of_freedom = {given} with a shaft that is fixed or that a host moves: nothing says where \
         along the axis it stands; modes in space are of a shaft that moves by itself, shaft.motion = \"internal\""
    )]
    HeldInSpace { given: usize },
    /// A load of nothing has no direction.
    #[error("the load on the bearing is {load:?} N: it must be finite and not 0; give shaft.load_n, or a load")]
    NoLoad { load: [f64; 2] },
    /// A healthy bearing was asked for its defect.
    #[error("the scene has no defect of a ring: a critical load belongs to one")]
    NoDefect,
    /// No element sinks into the defect.
    #[error("elements sink {depth_um} um into this defect: it must be above 0 to have a critical load")]
    NoDepth { depth_um: f64 },
}

/// A model in equilibrium: the cells of its contacts, its state, and forces there.
pub(crate) struct InBalance {
    pub(crate) cells: Cells,
    pub(crate) state: Vec<f64>,
    pub(crate) forces: Forces,
}

/// The equilibrium of a model under an excitation that stands.
///
/// # Errors
/// No equilibrium.
pub(crate) fn in_balance(model: &Model, excitation: &Excitation) -> Result<InBalance, StaticError> {
    let mut state = vec![0.0; model.layout.len];
    let cage_angle_deg = excitation.cage_start.to_degrees();
    let load = [0, 1, 2].map(|axis| excitation.load[0][axis].at(0.0));
    let refused = |cause| StaticError::Equilibrium { cage_angle_deg, load, cause };
    let cells = model.equilibrium_with_cells(excitation, &mut state).map_err(refused)?;
    let mut forces = Forces::of(model);
    model.derivative(excitation, 0.0, &cells, &state, &mut vec![0.0; state.len()], &mut forces);
    Ok(InBalance { cells, state, forces })
}

/// The surfaces of a scene's defects, and the contact map of these bytes if there is anything to look up in it.
///
/// # Errors
/// Whatever is wrong with a profile or with the map.
pub(crate) fn surfaces_and_map<'p>(
    scene: &Scene,
    profiles: impl IntoIterator<Item = &'p str>,
    map: Option<&[u8]>,
) -> Result<(Vec<Surface>, Option<Arc<ContactMaps>>), StaticError> {
    let surfaces = Surface::load_all(scene, profiles)?;
    let map = map.filter(|_| !surfaces.is_empty()).map(|bytes| stored_map(scene, &surfaces, bytes));
    Ok((surfaces, map.transpose()?.map(Arc::new)))
}
