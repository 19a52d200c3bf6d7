//! The shaft's speed over time, from a file with the columns `time_s` and `speed_hz`: straight lines between its rows.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::shared::csv;

/// Largest speed (Hz), as that of a scene.
const LARGEST: f64 = 1e4;

/// A speed at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    /// (s)
    time: f64,
    /// (Hz)
    speed: f64,
}

/// A speed that changes.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedProfile {
    /// In the order of their times, which ascend from 0.
    points: Vec<Point>,
}

impl SpeedProfile {
    /// Reads a file.
    ///
    /// # Errors
    /// What is no such profile, with the line, the value and what it must be.
    pub fn read(path: &Path) -> Result<Self> {
        let about = || path.display().to_string();
        let text = fs::read_to_string(path).with_context(about)?;
        Self::parse(&text).with_context(about)
    }

    fn parse(text: &str) -> Result<Self> {
        let (_, rows) = csv::pairs(text, "a speed profile", &[["time_s", "speed_hz"]])?;
        let mut points: Vec<Point> = Vec::new();
        for (line, row) in rows {
            points.push(point(row, points.last().copied()).with_context(|| format!("line {line}"))?);
        }
        Ok(Self { points })
    }

    /// Its last time (s).
    pub fn end(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.time)
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
        let after = self.points.partition_point(|point| point.time <= time).clamp(1, self.points.len() - 1);
        let (from, to) = (self.points[after - 1], self.points[after]);
        from.speed + (to.speed - from.speed) * ((time - from.time) / (to.time - from.time)).clamp(0.0, 1.0)
    }

    /// Speed at a time (s) (rad/s).
    pub fn at(&self, time: f64) -> f64 {
        TAU * self.hertz(time)
    }

    /// Whether the shaft keeps one speed.
    pub fn is_constant(&self) -> bool {
        self.points.iter().all(|point| point.speed == self.points[0].speed)
    }
}

/// The point of a row of numbers after the row `before`.
fn point([time, speed]: [f64; 2], before: Option<Point>) -> Result<Point> {
    match before {
        None if time != 0.0 => bail!("time_s is {time}: the first must be 0, where runs begin"),
        Some(Point { time: last, .. }) if time <= last => {
            bail!("time_s is {time}: it must be above {last}, that of the row before")
        }
        _ => {}
    }
    if speed.abs() > LARGEST {
        bail!("speed_hz is {speed}: it must be between -{LARGEST} and {LARGEST}; are they rev/min?");
    }
    Ok(Point { time, speed })
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
