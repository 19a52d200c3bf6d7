//! What an engineer reads out of a bearing's scene or a recording: stiffness, critical load, which part is damaged, the
//! length of a spall.

pub mod assembly;
pub mod contact_pressure;
pub mod contact_report;
mod continuity;
pub mod critical_load;
pub mod defect_below;
mod edges;
pub mod entry;
pub mod envelope;
pub mod envelope_spectrum;
pub mod error;
pub mod event_length;
pub mod events;
pub mod fault;
pub mod frequency_response;
mod interleaving;
mod kind;
mod linear_prediction;
mod load_zone;
pub mod measured;
pub mod mode_lines;
pub mod modes;
pub mod modes_report;
mod npy_header;
pub mod order_spectrum;
mod other_speed;
pub mod passages;
pub mod raceway;
pub mod recording;
mod recording_csv;
mod recording_file;
mod recording_npy;
pub mod report;
pub mod ringing;
pub mod sampling_times;
pub mod spall_size;
pub mod static_bearing;
pub mod statistics;
pub mod stiffness;
pub mod subsurface;
pub mod synthesis;
mod trial_search;
pub mod unresolved;
pub mod waveform_length;

pub use brinell_spectrum as spectrum;
