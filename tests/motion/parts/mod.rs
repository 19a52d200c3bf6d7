//! What a bearing may have besides equal balls evenly spaced on round, dry raceways.

mod cage;
mod film;
mod rollers;
mod unequal_elements;
mod waviness;
