//! `sensor.response` of a scene file: modes are fitted to the file it names and take its place in the scene's text, so
//! that FMU and simulations know modes only, and everyone sees them. They stand in its line: what is wrong further down
//! is reported with the line that it has in the file.

use anyhow::{Context, Error, Result, anyhow, bail};
use brinell::scene::SensorMode;
use brinell_analysis::spectra::{Fit, FrequencyResponse};
use brinell_scene_file::SceneFileError;

use crate::shared::note;

/// A scene's text with modes in place of every response; `read` gives the text of the file that a response names.
pub(crate) fn resolved(text: &str, read: impl Fn(&str) -> Result<String>) -> Result<String> {
    let mut resolved = String::with_capacity(text.len());
    let (mut of_sensor, mut has_one) = (false, false);
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let bare = line.trim();
        if bare.starts_with('[') {
            let head = bare.split('#').next().unwrap_or_default().trim();
            (of_sensor, has_one) = (["[sensor]", "[[sensor]]"].contains(&head), false);
        }
        let Some(file) = named(bare).filter(|_| of_sensor) else {
            resolved.push_str(line);
            continue;
        };
        let place = || format!("line {}: sensor.response \"{file}\"", number + 1);
        if has_one {
            bail!("{}: a sensor has one, not two", place());
        }
        if file.contains(['/', '\\', ':']) {
            bail!("{}: it must be the name of a file beside the scene", place());
        }
        let fit = read(&file).and_then(|text| Ok(FrequencyResponse::from_csv(&text)?.fit()?)).with_context(place)?;
        note!("{}: {} modes, which miss {:.2} % of it", place(), fit.modes.len(), 100.0 * fit.misfit);
        resolved.push_str(&modes(&file, &fit));
        resolved.push('\n');
        has_one = true;
    }
    Ok(resolved)
}

/// What is wrong with a response, and beside it all else that is wrong with the scene.
pub(crate) fn beside_other_faults(error: Error, text: &str) -> Error {
    let Err(SceneFileError::Keys(mut faults)) = brinell_scene_file::from_toml(text) else { return error };
    // That it was not fitted is what `error` says.
    faults.retain(|fault| !fault.to_string().contains("sensor.response"));
    if faults.is_empty() {
        return error;
    }
    let others: String = faults.iter().map(|fault| format!("\n  {fault}")).collect();
    anyhow!("scene file: {} faults\n  {error:#}{others}", faults.len() + 1)
}

/// The file that a line `response = "…"` names.
fn named(line: &str) -> Option<String> {
    let table: toml::Table = line.starts_with("response").then(|| line.parse().ok())??;
    table.get("response")?.as_str().map(str::to_owned)
}

/// The modes as a line of a scene file. Numbers are shown in full: they are what is simulated.
fn modes(file: &str, fit: &Fit) -> String {
    let mode = |mode: &SensorMode| {
        let SensorMode { frequency, damping_ratio, gain, quadrature_gain } = mode;
        format!(
            "{{ frequency_hz = {frequency:?}, damping_ratio = {damping_ratio:?}, gain = {gain:?}, quadrature_gain = \
             {quadrature_gain:?} }}"
        )
    };
    let modes: Vec<String> = fit.modes.iter().map(mode).collect();
    let misfit = 100.0 * fit.misfit;
    format!("mode = [{}] # {} modes fitted to {file:?}, which miss {misfit:.2} % of it.", modes.join(", "), modes.len())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use brinell_analysis::spectra::response;

    const SCENE: &str = include_str!("../../../scenes/6205-spall-5deg.toml");
    const MODE: SensorMode = SensorMode { frequency: 2300.0, damping_ratio: 0.03, gain: 0.8, quadrature_gain: 0.0 };

    fn table() -> String {
        let line = |k: i32| {
            let value = response(&[MODE], f64::from(k) * 50.0);
            format!("{},{:?},{:?}\n", k * 50, value.re, value.im)
        };
        "frequency_hz,real,imaginary\n".to_owned() + &(1..100).map(line).collect::<String>()
    }

    #[test]
    fn modes_take_the_place_of_a_response() {
        let named = |line: &str| SCENE.replace("\n[sensor]\n", &format!("\n[sensor]\n{line}\n"));
        let read = |name: &str| if name == "frf.csv" { Ok(table()) } else { bail!("no {name}") };
        let text = resolved(&named("response = \"frf.csv\" # measured"), read).unwrap();
        let scene = brinell_scene_file::from_toml(&text).unwrap();
        let mode = scene.sensors[0].modes[0];
        assert!(scene.sensors[0].modes.len() == 1 && (mode.frequency - MODE.frequency).abs() < 1e-6, "{mode:?}");
        assert!(text.contains("1 modes fitted to \"frf.csv\"") && text.contains("\n[solver]"), "{text}");
        // What follows is reported with its line in the file.
        let spoilt = named("response = \"frf.csv\"").replace("stop_s = ", "stop_s = -");
        let line = 1 + spoilt.lines().position(|line| line.starts_with("stop_s")).unwrap();
        let message = brinell_scene_file::from_toml(&resolved(&spoilt, read).unwrap()).unwrap_err().to_string();
        assert!(message.contains(&format!("line {line}: stop time")), "{message}");
        // Whatever has no response stays as it is.
        assert_eq!(resolved(SCENE, read).unwrap(), SCENE);
        assert!(resolved(&named("response = \"other.csv\""), read).unwrap_err().to_string().contains("other.csv"));
        assert!(resolved(&named("response = \"../frf.csv\""), read).unwrap_err().to_string().contains("beside"));
        let raw = brinell_scene_file::from_toml(&named("response = \"frf.csv\"")).unwrap_err().to_string();
        assert!(raw.contains("sensor.response") && raw.contains("frf.csv"), "{raw}");
    }
}
