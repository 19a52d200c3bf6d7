//! LabVIEW's measurement files (National Instruments, *Specification for the LabVIEW Measurement File*): a header that
//! says how numbers are written, one that says how far apart the samples are, names of the channels, rows.
//!
//! ```text
//! LabVIEW Measurement
//! Separator         Tab
//! Decimal_Separator ,
//! X_Columns         No
//! ***End_of_Header***
//!
//! Channels          1
//! X_Dimension       Time
//! Delta_X           1,953125E-5
//! ***End_of_Header***
//! X_Value           Acceleration    Comment
//!                   0,0138
//! ```
//!
//! Where `Delta_X` tells the rate, columns of times are left out. It is 1 where nobody set it.

use super::array::Contents;
use super::csv::{self, TextFormat};

const FIRST: &str = "LabVIEW Measurement";
const END: &str = "***End_of_Header***";

/// Whether a text is such a file.
pub(super) fn is(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').starts_with(FIRST)
}

/// What the file holds.
pub(super) fn contents(text: &str, format: TextFormat) -> Result<Contents, String> {
    let lines: Vec<&str> = text.lines().collect();
    let ends: Vec<usize> = (0..lines.len()).filter(|&i| lines[i].starts_with(END)).collect();
    let (&last, count) = (ends.get(1).or(ends.first()).ok_or_else(|| format!("no line {END}"))?, ends.len());
    if count > 2 {
        return Err(format!("{} segments, the second from line {} on: keep one", count - 1, ends[1] + 2));
    }
    let said = |key: &str| lines[..last].iter().rev().find_map(|line| line.strip_prefix(key));
    let comma = said("Separator").is_some_and(|value| value.contains("Comma"));
    let separator = format.delimiter.unwrap_or(if comma { ',' } else { '\t' });
    let decimal = said("Decimal_Separator").and_then(|value| value.trim().chars().last());
    let decimal = format.decimal.or(decimal).unwrap_or('.');
    let cells = |line: &'_ str| -> Vec<String> { line.split(separator).map(|cell| cell.trim().to_owned()).collect() };
    let numbers = |value: &str| -> Vec<Option<f64>> {
        let cells = cells(value).into_iter().filter(|cell| !cell.is_empty());
        cells.map(|cell| csv::number(&cell, decimal)).collect()
    };
    let in_time = said("X_Dimension").is_none_or(|value| cells(value).iter().all(|x| x.is_empty() || x == "Time"));
    let steps = said("Delta_X").map(numbers).unwrap_or_default();
    let step = steps.first().copied().flatten().filter(|step| in_time && *step > 0.0 && *step != 1.0);
    let rate = step.filter(|&step| steps.iter().all(|other| *other == Some(step))).map(|step| 1.0 / step);

    let heading = cells(lines.get(last + 1).ok_or("no line with the names of the channels")?);
    let without_x = said("X_Columns").is_some_and(|value| value.contains("No"));
    let kept: Vec<usize> = (0..heading.len())
        .filter(|&i| heading[i] != "Comment" && (heading[i] != "X_Value" || !(without_x || rate.is_some())))
        .collect();
    let mut columns = vec![Vec::new(); kept.len()];
    for (number, line) in (last + 3..).zip(&lines[last + 2..]).filter(|(_, line)| !line.trim().is_empty()) {
        let cells = cells(line);
        for (column, &i) in columns.iter_mut().zip(&kept) {
            let cell = cells.get(i).map_or("", String::as_str);
            let value = csv::number(cell, decimal).ok_or_else(|| {
                format!("line {number}: '{cell}' in column {} is no number (decimal sign '{decimal}')", heading[i])
            })?;
            column.push(value);
        }
    }
    let names = kept.iter().map(|&i| heading[i].clone()).collect();
    Ok(Contents { names, columns, rate, ..Contents::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of two channels.
    fn file(x: &str, step: &str, decimal: char, rows: &[&str]) -> String {
        let head = format!(
            "{FIRST}\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t{decimal}\nX_Columns\t{x}\n{END}\t\n\t\n\
             Channels\t2\t\nSamples\t2\t2\nX_Dimension\tTime\tTime\nX0\t0.0\t0.0\nDelta_X\t{step}\t{step}\n{END}\t\n\
             X_Value\tleft\tright\tComment\n"
        );
        head + &rows.join("\r\n")
    }

    #[test]
    fn the_header_tells_decimal_sign_and_rate_and_columns_have_their_names() {
        for text in [
            file("No", "0.00002", '.', &["\t0.5\t1e-3\tbegun", "\t-2\t3"]),
            file("No", "2,0E-5", ',', &["\t0,5\t1e-3", "\t-2,0\t3", ""]),
            // Times that are too coarse to tell samples apart are not needed.
            file("One", "0.00002", '.', &["0.0000\t0.5\t1e-3", "0.0000\t-2\t3"]),
        ] {
            assert!(is(&text));
            let read = contents(&text, TextFormat::default()).unwrap();
            assert_eq!(read.names, ["left", "right"]);
            assert_eq!(read.columns, [[0.5, -2.0], [1e-3, 3.0]]);
            // Rounding of 1/2e-5.
            assert!((read.rate.unwrap() / 50_000.0 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_step_that_nobody_set_is_no_rate_and_times_are_a_column_then() {
        let read = contents(&file("One", "1.000000", '.', &["0.0\t1\t2", "0.1\t3\t4"]), TextFormat::default()).unwrap();
        assert_eq!((read.rate, &read.names[0][..], &read.columns[0][..]), (None, "X_Value", &[0.0, 0.1][..]));
    }

    #[test]
    fn several_segments_missing_numbers_and_headers_without_end_are_refused() {
        let one = file("No", "0.1", '.', &["\t1\t2"]);
        let refused = |text: &str| contents(text, TextFormat::default()).unwrap_err();
        let second = "\nChannels\t2\n***End_of_Header***\nX_Value\tleft\tright\n\t1\t2";
        assert!(refused(&(one.clone() + second)).contains("2 segments"));
        assert!(
            refused(&(one.clone() + "\n\t3")).contains("line 16: '' in column right"),
            "{}",
            refused(&(one + "\n\t3"))
        );
        assert!(refused(FIRST).contains("no line ***End"));
        for len in 0..file("No", "0.1", '.', &[]).len() {
            let _ = contents(&file("No", "0.1", '.', &[])[..len], TextFormat::default());
        }
    }
}
