//! Growth: one bearing after the other, the defect of each in stages from small to large, all else being kept.
//!
//! How fast a spall grows nobody can tell: stages have an order and a size, and no time.

use toml::Value;

use super::{Entry, Reading, Sweep, number};

impl Sweep {
    /// How many runs each bearing has.
    pub(in crate::sweep) fn stages(&self) -> u64 {
        self.growing().map_or(1, |entry| entry.of.len().max(1) as u64)
    }

    /// Number of the bearing of a run: the run's own where nothing grows.
    pub(in crate::sweep) fn bearing(&self, run: u64) -> u64 {
        run / self.stages()
    }

    /// How far the defect of a run has grown: 0 of the first stage, 1 of the last, by size; `None` where nothing grows.
    pub(in crate::sweep) fn grown(&self, run: u64) -> Option<f64> {
        let sizes: Vec<f64> = self.growing()?.of.iter().filter_map(number).collect();
        let size = sizes.get((run % self.stages()) as usize)?;
        Some((size - sizes.first()?) / (sizes.last()? - sizes.first()?))
    }

    /// The keys of the grid that a bearing keeps.
    pub(in crate::sweep) fn fixed(&self) -> &[Entry<Vec<Value>>] {
        &self.grid[..self.grid.len() - usize::from(self.growing().is_some())]
    }

    /// The key that grows.
    fn growing(&self) -> Option<&Entry<Vec<Value>>> {
        self.grid.last().filter(|_| self.grows)
    }
}

impl Reading<'_, '_> {
    /// The table `[growth]`.
    pub(super) fn growth(&mut self) -> Option<Entry<Vec<Value>>> {
        let mut entries = self.entries("growth").into_iter();
        let Entry { key, of, line } = entries.next()?;
        if let Some(further) = entries.next() {
            let why = "what grows is one size, as in defect.length_mm = [0.5, 1, 2, 4]";
            self.fault(further.line, format!("growth.{} beside growth.{key}: {why}", further.key));
            return None;
        }
        let sizes: Option<Vec<f64>> = of.as_array().and_then(|all| all.iter().map(number).collect());
        match of {
            Value::Array(of) if sizes.is_some_and(|all| all.len() > 1 && all.is_sorted_by(|one, next| one < next)) => {
                Some(Entry { key, of, line })
            }
            other => {
                let limit = "a list of numbers, two at least, each larger than the one before";
                self.fault(line, format!("growth.{key} is {other}: it must be {limit}"));
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    const FILE: &str = "scene = \"er16k-tb1\"\nruns = 48\nkinds = [\"healthy\", \"outer\"]\nnoise_db = [0, 30]\n\
        split = [0.5, 0.25, 0.25]\n[grid]\ndefect.depth_um = [20, 50]\n[growth]\ndefect.length_mm = [0.5, 1, 2.5]\n\
        [random]\nshaft.load_n = [300, 1500]\n";

    #[test]
    fn a_bearing_keeps_all_but_the_size_that_grows_and_its_noise_is_new_in_each_stage() {
        let (sweep, faults) = Sweep::read(FILE).unwrap();
        assert_eq!(faults, []);
        let runs: Vec<_> = (0..sweep.runs).map(|index| sweep.run(index, &|_| false)).collect();
        for (bearing, stages) in runs.chunks(3).enumerate() {
            let sizes: Vec<f64> = stages.iter().map(|run| number(&run.values[1].1).unwrap()).collect();
            assert_eq!(sizes, [0.5, 1.0, 2.5]);
            let grown: Vec<f64> = stages.iter().map(|run| sweep.grown(run.index).unwrap()).collect();
            assert_eq!(grown, [0.0, 0.25, 1.0]);
            for run in stages {
                let (first, split) = (&stages[0], sweep.split.as_ref().unwrap());
                assert_eq!(sweep.bearing(run.index), bearing as u64);
                assert_eq!(
                    (run.kind, &run.values[0], &run.values[2]),
                    (first.kind, &first.values[0], &first.values[2])
                );
                let part = |run: &crate::sweep::design::Run| split.part(1, sweep.bearing(run.index), &run.values);
                assert_eq!(part(run), part(first));
                assert_eq!(run.noise.unwrap().ratio, first.noise.unwrap().ratio);
            }
            assert_ne!(stages[0].noise, stages[1].noise);
        }
        // Bearings take turns as runs do: kinds first, then the grid.
        let drawn: Vec<_> = runs.iter().step_by(3).map(|run| (run.kind, run.values[0].1.clone())).collect();
        assert_eq!(
            drawn[..4].iter().map(|(kind, _)| kind.unwrap().word()).collect::<Vec<_>>(),
            ["healthy", "outer", "healthy", "outer"]
        );
        assert_eq!((&drawn[0].1, &drawn[2].1), (&Value::Integer(20), &Value::Integer(50)));
        let whole = FILE.replace("runs = 48\n", "").replace("[random]\nshaft.load_n = [300, 1500]\n", "");
        assert_eq!(Sweep::read(&whole).unwrap().0.runs, 12, "two kinds, two depths, three stages");
    }
}
