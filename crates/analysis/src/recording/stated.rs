//! What a file says of itself in single numbers: the sampling rate and the shaft's speed, by what they are called.
//!
//! | name | is | known from |
//! |---|---|---|
//! | `fs`, `sr`, `sampling_rate` … | samples per second (`…_khz`: thousands) | `bearing.sr` of MFPT |
//! | `rpm`, `X209RPM` | revolutions of the shaft per minute | CWRU |
//! | `shaft_speed_rpm`, `motor_rpm`, `shaft_hz`, `rps` | the shaft's speed, in the unit that is said | |
//! | `speed`, `shaft_speed` | the same, in rev/min from 100 on and below in Hz | `Name` of Paderborn |
//! | `rate` beside a sampling rate | those per second | `bearing.rate` of MFPT |
//!
//! A number stands for a channel of its own structure, or whose name begins as its own: `X209RPM` says nothing of
//! `X210_DE_time`. A number without such a beginning stands for all channels.

/// Names of sampling rates, in small letters without signs between them.
const RATES: [&str; 9] = [
    "fs",
    "sr",
    "sfreq",
    "samplerate",
    "samplingrate",
    "samplefrequency",
    "samplingfrequency",
    "samplingfreq",
    "samplespersecond",
];
/// What a shaft's speed is called, in small letters without signs between them.
const SPEEDS: [&str; 10] = [
    "speed",
    "shaftspeed",
    "shaft",
    "motorspeed",
    "motor",
    "rotorspeed",
    "rotor",
    "spindlespeed",
    "rotationalspeed",
    "rotationspeed",
];
/// Those that say it without a unit.
const BARE_SPEEDS: [&str; 2] = ["speed", "shaftspeed"];
/// Speeds without a unit are rev/min from here on, and below in Hz.
const TURNS_A_MINUTE: f64 = 100.0;
/// Slower than any recording that shows a bearing: `fs` also names the frequency of the shaft (Hz).
const SLOWEST: f64 = 500.0;

/// A frequency that a file states.
#[derive(Debug, Clone, PartialEq)]
pub struct Stated {
    /// What the number is called in the file.
    pub name: String,
    /// The number.
    pub value: f64,
    /// What it is in hertz.
    pub hertz: f64,
}

impl Stated {
    /// As the command line takes a speed.
    pub fn as_speed(&self) -> String {
        if self.value == self.hertz { self.value.to_string() } else { format!("{}rpm", self.value) }
    }
}

/// The sampling rate of a channel.
pub(super) fn rate(numbers: &[(String, f64)], channel: &str) -> Option<Stated> {
    let read = |name: &str, value: f64| {
        let name = last(name);
        let (name, unit) = match name.strip_suffix("khz") {
            Some(name) => (name, 1e3),
            None => (name.strip_suffix("hz").unwrap_or(&name), 1.0),
        };
        (RATES.contains(&name) && unit * value >= SLOWEST).then_some(("", unit))
    };
    of_channel(numbers, channel, &read)
}

/// The shaft's speed while a channel was recorded.
pub(super) fn speed<'n>(numbers: &'n [(String, f64)], channel: &str) -> Option<Stated> {
    let rates = |path: &str| {
        let (structure, _) = path.rsplit_once('.').unwrap_or_default();
        let beside = numbers.iter().filter(|(name, _)| name.rsplit_once('.').unwrap_or_default().0 == structure);
        !structure.is_empty() && beside.clone().any(|(name, _)| RATES.contains(&&*last(name)))
    };
    let is_speed = |name: Option<&str>| name.is_some_and(|name| SPEEDS.contains(&name) || name == "n");
    let read = |name: &'n str, value: f64| match last(name) {
        last if is_speed(last.strip_suffix("rpm")) => Some(("", 1.0 / 60.0)),
        last if is_speed(last.strip_suffix("hz")) || last == "rps" => Some(("", 1.0)),
        last if BARE_SPEEDS.contains(&&*last) => Some(("", if value < TURNS_A_MINUTE { 1.0 } else { 1.0 / 60.0 })),
        last if last.ends_with("rpm") => {
            let own = &name[name.rfind('.').map_or(0, |dot| dot + 1)..];
            let cut = own.char_indices().rev().nth(2).map_or(0, |(at, _)| at);
            Some((own[..cut].trim_end_matches(['_', ' ', '.', '-']), 1.0 / 60.0)).filter(|_| own.is_ascii())
        }
        last if last == "rate" && rates(name) => Some(("", 1.0)),
        _ => None,
    };
    of_channel(numbers, channel, &read)
}

/// The one number that `read` takes, by its name and value, for a frequency of this channel: what its name begins with
/// beside its structure, and Hz for 1.
fn of_channel<'n>(
    numbers: &'n [(String, f64)],
    channel: &str,
    read: &dyn Fn(&'n str, f64) -> Option<(&'n str, f64)>,
) -> Option<Stated> {
    let mut found: Option<Stated> = None;
    for (name, value) in numbers.iter().filter(|(_, value)| value.is_finite() && *value > 0.0) {
        let Some((begin, unit)) = read(name, *value) else { continue };
        let structure = name.rfind('.').map_or("", |dot| &name[..=dot]);
        // Behind a name in the file its path stands in brackets.
        let path = channel.rsplit_once(" (").map_or(channel, |(_, path)| path);
        if !path.starts_with(&format!("{structure}{begin}")) {
            continue;
        }
        let stated = Stated { name: name.clone(), value: *value, hertz: unit * value };
        if found.as_ref().is_some_and(|other| other.hertz != stated.hertz) {
            return None;
        }
        found.get_or_insert(stated);
    }
    found
}

/// The last part of a path in small letters, without signs between them.
fn last(path: &str) -> String {
    let last = path.rsplit('.').next().unwrap_or_default();
    last.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(list: &[(&str, f64)]) -> Vec<(String, f64)> {
        list.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    }

    #[test]
    fn rates_and_speeds_are_known_by_their_names_and_stand_for_their_own_channels() {
        let mfpt = numbers(&[("bearing.sr", 97_656.0), ("bearing.load", 270.0), ("bearing.rate", 25.0)]);
        assert_eq!(rate(&mfpt, "bearing.gs").unwrap().hertz, 97_656.0);
        let of = speed(&mfpt, "bearing.gs").unwrap();
        assert_eq!((&of.name[..], of.as_speed()), ("bearing.rate", "25".to_owned()));
        // A `rate` beside no sampling rate may be anything.
        assert_eq!(speed(&numbers(&[("bearing.rate", 25.0)]), "bearing.gs"), None);

        let cwru = numbers(&[("X098RPM", 1772.0), ("ans", 1.0)]);
        let of = speed(&cwru, "X098_DE_time").unwrap();
        assert_eq!((of.value, of.as_speed()), (1772.0, "1772rpm".to_owned()));
        // Rounding of 1/60.
        assert!((of.hertz - 1772.0 / 60.0).abs() < 1e-12);
        assert_eq!((speed(&cwru, "X099_DE_time"), rate(&cwru, "X098_DE_time")), (None, None));

        for (name, value, hertz) in [
            ("fs", 12e3, 12e3),
            ("Fs", 12e3, 12e3),
            ("fs_kHz", 12.0, 12e3),
            ("SampleRate", 12e3, 12e3),
            ("sampling_rate_hz", 12e3, 12e3),
        ] {
            assert_eq!(rate(&numbers(&[(name, value)]), "acc").unwrap().hertz, hertz, "{name}");
        }
        // The shaft's frequency, two that contradict each other, and one of another structure.
        assert_eq!(rate(&numbers(&[("fs", 29.95)]), "acc"), None);
        assert_eq!(rate(&numbers(&[("fs", 12e3), ("sr", 48e3)]), "acc"), None);
        assert_eq!(rate(&numbers(&[("b.fs", 12e3)]), "a.acc"), None);
        assert_eq!(rate(&numbers(&[("a.fs", 12e3)]), "vibration_1 (a.acc)").unwrap().hertz, 12e3);
        for (name, value, hertz) in [
            ("shaft_speed_rpm", 600.0, 10.0),
            ("motor_rpm", 600.0, 10.0),
            ("n_rpm", 600.0, 10.0),
            ("speed_hz", 10.0, 10.0),
            ("shaft_hz", 10.0, 10.0),
            ("rps", 10.0, 10.0),
            ("speed", 600.0, 10.0),
            ("shaft_speed", 10.0, 10.0),
        ] {
            assert_eq!(speed(&numbers(&[(name, value)]), "acc").unwrap().hertz, hertz, "{name}");
        }
        for name in ["rpm", "RPM", "n.rpm", "µrpm", "m"] {
            let _ = speed(&numbers(&[(name, 1.0)]), "n.x");
        }
    }
}
