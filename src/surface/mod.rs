//! The outer raceway as it was measured or described.
