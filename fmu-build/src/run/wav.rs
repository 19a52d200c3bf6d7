//! What sensors show as sound: a WAV file with a channel for each, of 32-bit floats.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::signals::Signals;
use crate::shared::whole_file;

/// Largest file (bytes): its lengths are numbers of 32 bits.
const LARGEST: u64 = 0xffff_ff00;

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wav {
    /// Samples per second (Hz); `None` for those of the scene's recorder.
    pub rate: Option<f64>,
    /// Acceleration that becomes 1 (m/s²).
    pub scale: f64,
}

impl Wav {
    /// Refuses what no WAV file can be.
    pub fn check(&self) -> Result<()> {
        if let Some(rate) = self.rate {
            whole_rate(rate)?;
        }
        if !(self.scale.is_finite() && self.scale > 0.0) {
            bail!("scale of the WAV file {} m/s2: it must be finite and above 0", self.scale);
        }
        Ok(())
    }

    /// Writes the signals at these indices, sampled at `rate` (Hz). Gives the largest size of a sample and the share of
    /// samples beyond 1, which the file holds and players clip.
    pub fn write(&self, signals: &Signals, indices: &[usize], rate: f64, path: &Path) -> Result<[f64; 2]> {
        let length = 4 * signals.rows() * indices.len() as u64;
        if length > LARGEST {
            bail!("{length} bytes of samples: a WAV file holds at most {LARGEST}; take a shorter run or a lower rate");
        }
        let spec = hound::WavSpec {
            channels: u16::try_from(indices.len()).context("channels")?,
            sample_rate: whole_rate(rate)?,
            bits_per_sample: 32,
            sample_format: hound::SampleFormat::Float,
        };
        let (mut largest, mut beyond) = (0.0f64, 0u64);
        let mut bytes = Cursor::new(Vec::with_capacity(length as usize + 128));
        let mut writer = hound::WavWriter::new(&mut bytes, spec)?;
        signals.each_row(|row| {
            for &index in indices {
                let sample = row[index] / self.scale;
                largest = largest.max(sample.abs());
                beyond += u64::from(sample.abs() > 1.0);
                writer.write_sample(sample as f32)?;
            }
            Ok(())
        })?;
        writer.finalize()?;
        if !(largest <= f64::from(f32::MAX)) {
            bail!("largest sample {largest}: it must be below {:e}; --wav-scale makes it smaller", f32::MAX);
        }
        whole_file::write_with(path, |out| Ok(out.write_all(bytes.get_ref())?))?;
        let count = signals.rows() * indices.len() as u64;
        Ok([largest, beyond as f64 / count.max(1) as f64])
    }
}

fn whole_rate(rate: f64) -> Result<u32> {
    if !(rate.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&rate)) {
        bail!("rate of the WAV file {rate} Hz: it must be a whole number, as the file has it");
    }
    Ok(rate as u32)
}
