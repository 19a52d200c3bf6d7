//! Equations of motion of rings, elements and sensor.
