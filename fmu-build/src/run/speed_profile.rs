//! The shaft's speed over time, from a file with the columns `time_s` and `speed_hz`: straight lines between its rows.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};
use brinell::scene::Bearing;

use crate::package::model::ask_unit;
use crate::shared::csv;

/// Largest speed (Hz), as that of a scene.
const LARGEST: f64 = 1e4;

/// A speed that changes.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedProfile {
    /// Times (s), which ascend from 0, and speeds (Hz).
    points: Vec<[f64; 2]>,
}

impl SpeedProfile {
    /// Reads a file; a speed that this bearing hardly has is asked about.
    ///
    /// # Errors
    /// What is no such profile, with the line, the value and what it must be.
    pub fn read(path: &Path, bearing: &Bearing) -> Result<Self> {
        let about = || path.display().to_string();
        let text = fs::read_to_string(path).with_context(about)?;
        let profile = Self::parse(&text).with_context(about)?;
        let fastest = profile.points.iter().map(|[_, speed]| *speed).max_by(|a, b| a.abs().total_cmp(&b.abs()));
        ask_unit(bearing, "shaft.speed_hz", fastest.unwrap_or(0.0), format_args!("{}: speed_hz", path.display()));
        Ok(profile)
    }

    fn parse(text: &str) -> Result<Self> {
        let (_, rows) = csv::pairs(text, "a speed profile", &[["time_s", "speed_hz"]])?;
        let (line, [begin, _]) = rows[0];
        if begin != 0.0 {
            bail!("line {line}: time_s is {begin}: the first must be 0, where runs begin");
        }
        if let Some((line, [_, speed])) = rows.iter().find(|(_, [_, speed])| speed.abs() > LARGEST) {
            bail!("line {line}: speed_hz is {speed}: it must be between -{LARGEST} and {LARGEST}; are they rev/min?");
        }
        Ok(Self { points: rows.into_iter().map(|(_, point)| point).collect() })
    }

    /// Its last time (s).
    pub fn end(&self) -> f64 {
        self.points.last().map_or(0.0, |[time, _]| *time)
    }

    /// Refuses a run that goes on after the profile has ended (s).
    pub fn check_covers(&self, stop: f64) -> Result<()> {
        // The stop time is a multiple of the step up to rounding.
        if stop > self.end() * (1.0 + 1e-9) {
            bail!("the run goes to {stop} s: it must end by {} s, the last time_s of the speed profile", self.end());
        }
        Ok(())
    }

    /// Speed at a time (s) (Hz).
    pub fn hertz(&self, time: f64) -> f64 {
        let after = self.points.partition_point(|[of, _]| *of <= time).clamp(1, self.points.len() - 1);
        let ([begin, from], [end, to]) = (self.points[after - 1], self.points[after]);
        from + (to - from) * ((time - begin) / (end - begin)).clamp(0.0, 1.0)
    }

    /// Speed at a time (s) (rad/s).
    pub fn at(&self, time: f64) -> f64 {
        TAU * self.hertz(time)
    }

    /// Whether the shaft keeps one speed.
    pub fn is_constant(&self) -> bool {
        self.points.iter().all(|[_, speed]| *speed == self.points[0][1])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn speeds_lie_on_straight_lines_between_the_rows() {
        let profile = SpeedProfile::parse("time_s,speed_hz\n0,10\n0.5,20\n# a pause\n1,20\n2,-20\n").unwrap();
        for (time, speed) in [(0.0, 10.0), (0.25, 15.0), (0.5, 20.0), (0.7, 20.0), (1.5, 0.0), (2.0, -20.0)] {
            assert!((profile.hertz(time) - speed).abs() < 1e-12, "{time}: {}", profile.hertz(time));
        }
        assert!(profile.check_covers(2.0 + 1e-12).is_ok() && !profile.is_constant());
        let why = profile.check_covers(2.5).unwrap_err().to_string();
        assert!(why.contains("goes to 2.5 s") && why.contains("by 2 s"), "{why}");
    }
}
