//! A raceway or an element as it was measured or described.
//!
//! Everywhere the arc s (m) runs along the body's surface at the groove's bottom or on the element's track,
//! counter-clockwise in the body's own sense, from the defect's centre, and the depth h (m) is that of a depression:
//! positive into the body. Outside the defect the surface is smooth, h = 0. A raised rim is a negative depth.
//!
//! ```
//! use brinell::surface::{Profile, Surface};
//!
//! // A spall of 2 mm, 50 µm deep, with vertical edges.
//! let spall = Surface::Profile(Profile::spall(2e-3, 50e-6, std::f64::consts::FRAC_PI_2));
//! assert_eq!(spall.edges(), [-1e-3, 1e-3]);
//! // Of a cell along the raceway that is half over the edge, half is as deep as the floor.
//! let depth = spall.mean_depth([0.9e-3, 1.1e-3], [0.0, 1e-4]);
//! assert!((depth - 25e-6).abs() < 1e-12);
//! ```

mod csv;
mod error;
mod interval;
mod measured;
mod profile;
pub(crate) mod roller_profile;
mod topography;
mod trace;
mod waviness;

pub use error::SurfaceError;
pub use interval::Interval;
pub use measured::{curvature_of_ends, line_through_ends};
pub use profile::Profile;
pub(crate) use profile::{Corner, rounded};
pub use roller_profile::with_roller_profile;
pub use topography::Topography;
pub use waviness::Waves;

use crate::scene::{Bearing, Defect, DefectOn, DefectShape, Scene};

/// The surface of a defect.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// The same depth over the whole width of the raceway.
    Profile(Profile),
    /// Depth over arc and width.
    Topography(Topography),
}

impl Surface {
    /// The surface of a defect in this bearing. `profile_text` is the text of the file that its shape names.
    ///
    /// A file with a column `axial_mm` is a topography, one without a trace.
    ///
    /// # Errors
    /// A file that is missing, cannot be read, is longer than the body is around or deeper than it may be.
    pub fn load(defect: &Defect, profile_text: Option<&str>, bearing: &Bearing) -> Result<Self, SurfaceError> {
        let measured = match &defect.shape {
            DefectShape::Spall { length, depth, edge_slope } => {
                let met = defect.on.met_length(*length, bearing);
                return Ok(Self::Profile(Profile::spall(met, *depth, *edge_slope)));
            }
            DefectShape::Profile(measured) => measured,
        };
        let text = profile_text.ok_or_else(|| SurfaceError::NoFile { name: measured.file.clone() })?;
        let surface = if csv::has_column(text, topography::AXIAL) {
            Self::Topography(Topography::measured(text, measured)?)
        } else {
            Self::Profile(Profile::measured(text, measured)?)
        };
        surface.check_fits(defect.on, bearing)?;
        Ok(surface)
    }

    /// The surfaces of all defects of a scene, in their order. `profiles` are the texts of the files that they name, in
    /// the order of [`Scene::profile_names`].
    ///
    /// # Errors
    /// Those of [`load`](Self::load), with the number of the defect where there are several.
    pub fn load_all<'p>(scene: &Scene, profiles: impl IntoIterator<Item = &'p str>) -> Result<Vec<Self>, SurfaceError> {
        let texts: Vec<(&str, &str)> = scene.profile_names().into_iter().zip(profiles).collect();
        let surface = |(index, defect): (usize, &Defect)| {
            let text = match &defect.shape {
                DefectShape::Profile(of) => texts.iter().find(|(name, _)| *name == of.file).map(|&(_, text)| text),
                DefectShape::Spall { .. } => None,
            };
            let several = scene.defects.len() > 1;
            Self::load(defect, text, &scene.bearing)
                .map_err(|of| if several { SurfaceError::OfDefect { number: index + 1, of: Box::new(of) } } else { of })
        };
        scene.defects.iter().enumerate().map(surface).collect()
    }

    /// The same surface with every depth multiplied by `factor`.
    ///
    /// # Errors
    /// A surface that becomes deeper than an element's radius.
    pub fn scaled(&self, factor: f64, on: DefectOn, bearing: &Bearing) -> Result<Self, SurfaceError> {
        let scaled = match self {
            Self::Profile(profile) => Self::Profile(profile.scaled(factor)),
            Self::Topography(topography) => Self::Topography(topography.scaled(factor)),
        };
        scaled.check_fits(on, bearing)?;
        Ok(scaled)
    }

    /// As it lies about another place across the raceway (m), which is 0 then; a profile is the same everywhere across.
    pub fn seen_from(self, axial: f64) -> Self {
        match self {
            Self::Profile(_) => self,
            Self::Topography(topography) => Self::Topography(topography.seen_from(axial)),
        }
    }

    /// First and last arc (m) of the defect.
    pub fn extent(&self) -> (f64, f64) {
        match self {
            Self::Profile(profile) => profile.extent(),
            Self::Topography(topography) => topography.extent(),
        }
    }

    /// Whether the profile is its own mirror image about arc 0, to the bit. Topographies are not asked.
    pub(crate) fn is_symmetric(&self) -> bool {
        match self {
            Self::Profile(profile) => {
                let mirrored = profile.points().iter().rev().map(|&(arc, depth)| (-arc, depth));
                mirrored.eq(profile.points().iter().copied())
            }
            Self::Topography(_) => false,
        }
    }

    /// Arcs (m), ascending, at which the depth jumps.
    pub fn edges(&self) -> Vec<f64> {
        match self {
            Self::Profile(profile) => profile.edges(),
            Self::Topography(topography) => topography.edges(),
        }
    }

    /// The longest interval along the raceway, and across it, between measured points of different depth; `None` where
    /// the surface is not measured or does not change.
    pub fn coarsest_intervals(&self) -> [Option<Interval>; 2] {
        match self {
            Self::Profile(profile) => [profile.coarsest(), None],
            Self::Topography(topography) => topography.coarsest(),
        }
    }

    /// Exact mean depth (m) of the cell between two arcs and two axial coordinates (m).
    pub fn mean_depth(&self, arc: [f64; 2], axial: [f64; 2]) -> f64 {
        match self {
            Self::Profile(profile) => profile.mean_depth(arc[0], arc[1]),
            Self::Topography(topography) => topography.mean_depth(arc, axial),
        }
    }

    /// Depths (m) of all points.
    pub fn depths(&self) -> Box<dyn Iterator<Item = f64> + '_> {
        match self {
            Self::Profile(profile) => Box::new(profile.points().iter().map(|&(_, depth)| depth)),
            Self::Topography(topography) => Box::new(topography.depths().iter().copied()),
        }
    }

    /// Refuses a surface that is not possible on a body of this bearing.
    fn check_fits(&self, on: DefectOn, bearing: &Bearing) -> Result<(), SurfaceError> {
        let (longest, element_radius) = (on.longest(bearing), bearing.element_radius());
        let (first, last) = self.extent();
        if last - first >= longest.size {
            return Err(SurfaceError::TooLong {
                length_mm: (last - first) * 1e3,
                limit_mm: longest.size * 1e3,
                limit: longest.what,
            });
        }
        if let Self::Topography(topography) = self
            && let [first, .., last] = *topography.axials()
            && last - first >= bearing.pitch_diameter
        {
            let (width_mm, limit_mm) = ((last - first) * 1e3, bearing.pitch_diameter * 1e3);
            return Err(SurfaceError::TooWide { width_mm, limit_mm });
        }
        let (arc, depth) = match self {
            Self::Profile(profile) => profile.farthest(),
            Self::Topography(topography) => topography.farthest(),
        };
        let deepest = on.deepest(bearing);
        if depth.abs() >= deepest.size {
            return Err(SurfaceError::TooDeep {
                arc_mm: arc * 1e3,
                depth_um: depth * 1e6,
                limit_um: deepest.size * 1e6,
                limit: deepest.what,
            });
        }
        let (shallowest, deepest) = self.depths().fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
        if deepest - shallowest >= element_radius {
            let (height_um, limit_um) = ((deepest - shallowest) * 1e6, element_radius * 1e6);
            return Err(SurfaceError::TooRugged { height_um, limit_um });
        }
        Ok(())
    }
}
