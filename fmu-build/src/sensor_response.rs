//! `sensor.response` of a scene file: modes are fitted to the file it names and take its place in the scene's text, so
//! that FMU and simulations know modes only, and everyone sees them.

use std::fmt::Write;

use anyhow::{Context, Result, bail};
use brinell_analysis::frequency_response::{Fit, FrequencyResponse};

/// A scene's text with modes in place of every response; `read` gives the text of the file that a response names.
pub(crate) fn resolved(text: &str, read: impl Fn(&str) -> Result<String>) -> Result<String> {
    let mut resolved = String::with_capacity(text.len());
    let (mut of_sensor, mut modes) = (false, String::new());
    for line in text.split_inclusive('\n') {
        let bare = line.trim();
        if bare.starts_with('[') {
            resolved.push_str(&std::mem::take(&mut modes));
            let head = bare.split('#').next().unwrap_or_default().trim();
            of_sensor = ["[sensor]", "[[sensor]]"].contains(&head);
        }
        match named(bare).filter(|_| of_sensor) {
            None => resolved.push_str(line),
            Some(_) if !modes.is_empty() => bail!("sensor.response: a sensor has one, not two"),
            Some(file) => {
                let said = || format!("sensor.response \"{file}\"");
                if file.contains(['/', '\\', ':']) {
                    bail!("{}: it must be the name of a file beside the scene", said());
                }
                let fit = FrequencyResponse::from_csv(&read(&file)?).and_then(|of| of.fit()).with_context(said)?;
                eprintln!("{}: {} modes, which miss {:.2} % of it", said(), fit.modes.len(), 100.0 * fit.misfit);
                modes = tables(&file, &fit);
            }
        }
    }
    if !modes.is_empty() && !resolved.ends_with('\n') {
        resolved.push('\n');
    }
    resolved.push_str(&modes);
    Ok(resolved)
}

/// The file that a line `response = "…"` names.
fn named(line: &str) -> Option<String> {
    let table: toml::Table = line.starts_with("response").then(|| line.parse().ok())??;
    table.get("response")?.as_str().map(str::to_owned)
}

/// The modes as tables of a scene file. Numbers are shown in full: they are what is simulated.
fn tables(file: &str, fit: &Fit) -> String {
    let mut tables =
        format!("# {} modes fitted to {file:?}, which miss {:.2} % of it.\n", fit.modes.len(), 100.0 * fit.misfit);
    for mode in &fit.modes {
        let brinell::scene::SensorMode { frequency, damping_ratio, gain, quadrature_gain } = mode;
        // Writing to a string cannot fail.
        let _ = write!(
            tables,
            "[[sensor.mode]]\nfrequency_hz = {frequency:?}\ndamping_ratio = {damping_ratio:?}\ngain = {gain:?}\n\
             quadrature_gain = {quadrature_gain:?}\n"
        );
    }
    tables + "\n"
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use brinell::scene::{Scene, SensorMode};
    use brinell_analysis::frequency_response::response;

    const SCENE: &str = include_str!("../../scenes/6205-spall-5deg.toml");
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
        let scene = Scene::from_toml(&text).unwrap();
        let mode = scene.sensors[0].modes[0];
        assert!(scene.sensors[0].modes.len() == 1 && (mode.frequency - MODE.frequency).abs() < 1e-6, "{mode:?}");
        assert!(text.contains("1 modes fitted to \"frf.csv\"") && text.contains("\n[solver]"), "{text}");
        // Whatever has no response stays as it is.
        assert_eq!(resolved(SCENE, read).unwrap(), SCENE);
        assert!(resolved(&named("response = \"other.csv\""), read).unwrap_err().to_string().contains("other.csv"));
        assert!(resolved(&named("response = \"../frf.csv\""), read).unwrap_err().to_string().contains("beside"));
        let raw = Scene::from_toml(&named("response = \"frf.csv\"")).unwrap_err().to_string();
        assert!(raw.contains("sensor.response") && raw.contains("frf.csv"), "{raw}");
    }
}
