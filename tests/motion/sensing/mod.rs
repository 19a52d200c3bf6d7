//! What is measured: accelerometers, the structure under them, the recorder.

mod recorder;
mod recorder_filter;
mod sensor_modes;
mod sensors;
