//! Recordings as text: numbers in columns, parted and with decimals as a [`TextFormat`] says. Nothing is guessed: a
//! text that does not read so is refused with the line and the options that would say how it is written.
//!
//! Lines before the first that consists of numbers are a preamble, and the last of them with as many cells is the
//! heading. Lines that begin with # are comments. Without a heading the shorter side counts the channels, as in arrays:
//! one long row is one channel.

use super::array::Columns;

/// Lines of preamble after which the file is taken for something else.
const LONGEST_PREAMBLE: usize = 100;

/// How a text's numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TextFormat {
    /// What stands between columns; a blank is any number of blanks and tabs. Left out: a tab in `.tsv` and `.lvm`,
    /// else a semicolon where the decimal sign is a comma, a comma in `.csv`, and a blank in all other files.
    pub delimiter: Option<char>,
    /// Decimal sign, a point or a comma; left out, a point.
    pub decimal: Option<char>,
}

impl TextFormat {
    /// Delimiter and decimal sign of a file that ends so.
    fn signs(self, ending: &str) -> Result<(u8, char), String> {
        let decimal = self.decimal.unwrap_or('.');
        let delimiter = self.delimiter.unwrap_or(match ending {
            "tsv" | "lvm" => '\t',
            _ if decimal == ',' => ';',
            "csv" => ',',
            _ => ' ',
        });
        let byte = u8::try_from(delimiter).ok().filter(|&byte| byte.is_ascii() && !byte.is_ascii_alphanumeric());
        match byte {
            _ if !matches!(decimal, '.' | ',') => Err(format!("decimal sign '{decimal}': it is a point or a comma")),
            Some(byte) if delimiter != decimal && !matches!(byte, b'-' | b'+' | b'.' | b'"' | b'#') => {
                Ok((byte, decimal))
            }
            _ => Err(format!(
                "delimiter '{delimiter}': it is a comma, a semicolon, a tab, a blank or another sign that no number \
                 has (decimal sign '{decimal}')"
            )),
        }
    }
}

/// The columns of a text in a file that ends so.
pub(crate) fn columns(text: &str, ending: &str, format: TextFormat) -> Result<Columns, String> {
    let (delimiter, decimal) = format.signs(ending)?;
    let how = format!(
        "columns are parted by {} and decimals by '{decimal}' unless --delimiter and --decimal say otherwise",
        if delimiter == b' ' { "blanks".to_owned() } else { format!("'{}'", char::from(delimiter).escape_default()) }
    );
    let text = text.trim_start_matches('\u{feff}');
    let (text, delimiter) = if delimiter == b' ' { (&*tabs_for_blanks(text), b'\t') } else { (text, delimiter) };
    let mut reader = csv::ReaderBuilder::new();
    reader.has_headers(false).flexible(true).delimiter(delimiter).comment(Some(b'#')).trim(csv::Trim::All);
    let (mut preamble, mut columns) = (Vec::<csv::StringRecord>::new(), Vec::<Vec<f64>>::new());
    let mut names = Vec::new();
    for record in reader.from_reader(text.as_bytes()).into_records() {
        let record = record.map_err(|why| why.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let cells = cells(&record);
        let number_or_clock = |cell: &&str| number(cell, decimal).or_else(|| is_clock(cell).then_some(f64::NAN));
        let numbers: Option<Vec<f64>> = cells.iter().map(number_or_clock).collect();
        if columns.is_empty() {
            let has_numbers = cells.iter().any(|cell| number(cell, decimal).is_some());
            let Some(first) = numbers.filter(|_| has_numbers) else {
                preamble.push(record);
                if preamble.len() > LONGEST_PREAMBLE {
                    break;
                }
                continue;
            };
            columns.extend(first.into_iter().map(|value| vec![value]));
            let heading = preamble.iter().rev().map(|line| self::cells(line)).find(|line| line.len() == cells.len());
            names = heading.unwrap_or_default().into_iter().map(str::to_owned).collect();
            continue;
        }
        if cells.len() != columns.len() {
            let (count, width) = (cells.len(), columns.len());
            return Err(format!("line {line}: {count} columns, the first row of numbers has {width}; {how}"));
        }
        let numbers = numbers.ok_or_else(|| {
            let cell = cells.iter().find(|cell| number(cell, decimal).is_none()).copied().unwrap_or_default();
            format!("line {line}: '{cell}' is not a number; {how}")
        })?;
        columns.iter_mut().zip(numbers).for_each(|(column, value)| column.push(value));
    }
    if columns.is_empty() {
        let last = text.lines().filter(|line| !line.trim().is_empty()).take(LONGEST_PREAMBLE).last();
        let last = last.map_or(String::new(), |line| format!(", the last of them '{line:.60}'"));
        return Err(format!("no line of numbers among the first {LONGEST_PREAMBLE}{last}; {how}"));
    }
    if names.is_empty() && columns.len() > columns[0].len() {
        columns = (0..columns[0].len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
    }
    Ok((names, columns))
}

/// The same text with one tab for each run of blanks.
fn tabs_for_blanks(text: &str) -> String {
    text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join("\t") + "\n").collect()
}

fn cells(record: &csv::StringRecord) -> Vec<&str> {
    let mut cells: Vec<&str> = record.iter().collect();
    // Some programs end every line with a delimiter.
    if cells.len() > 1 && cells.last() == Some(&"") {
        cells.pop();
    }
    cells
}

/// Whether this is a date or a time of the day, which is no number of a channel.
fn is_clock(cell: &str) -> bool {
    let count = |signs: &[char]| cell.matches(signs).count();
    cell.starts_with(|c: char| c.is_ascii_digit())
        && cell.chars().all(|c| c.is_ascii_digit() || "-/:.,+ TZ".contains(c))
        && (count(&[':']) >= 1 || count(&['-', '/']) == 2)
}

/// A number with this decimal sign and no other.
pub(super) fn number(cell: &str, decimal: char) -> Option<f64> {
    if decimal == '.' {
        return cell.parse().ok();
    }
    if cell.contains('.') { None } else { cell.replace(decimal, ".").parse().ok() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(delimiter: char, decimal: char) -> TextFormat {
        TextFormat { delimiter: Some(delimiter), decimal: Some(decimal) }
    }

    #[test]
    fn delimiters_preambles_headings_and_decimal_commas_are_read_as_they_are_given() {
        let default = TextFormat::default();
        let expected = vec![vec![0.0, 0.5], vec![1.5, -2.0]];
        for (text, ending, format) in [
            ("time,acc\n0.0,1.5\n0.5,-2.0\n", "csv", default),
            ("\u{feff}time;acc\r\n0,0;1,5\r\n0,5;-2,0\r\n", "csv", TextFormat { delimiter: None, decimal: Some(',') }),
            ("recorder 7\nrate: fast\n\"time\"\t\"acc\"\n0\t1.5\n0.5\t-2\n", "csv", with('\t', '.')),
            ("# comment\ntime acc\n0  1.5\n 0.5 -2e0\n", "txt", default),
            ("time\tacc\n0\t 1.5\n0.5\t-2e0\n", "txt", default),
            ("time,acc,\n0.0,1.5,\n0.5,-2.0,\n", "csv", default),
            ("time,acc\n\"0,0\",\"1,5\"\n\"0,5\",\"-2,0\"\n", "csv", with(',', '.')),
        ] {
            let read = columns(text, ending, format);
            if text.contains("\"0,0\"") {
                assert!(read.is_err(), "decimal commas are not read as points");
                continue;
            }
            assert_eq!(read.unwrap(), (vec!["time".to_owned(), "acc".to_owned()], expected.clone()), "{text}");
        }
        assert_eq!(columns("1.5\n2.5\n", "csv", default).unwrap(), (Vec::new(), vec![vec![1.5, 2.5]]));
        assert_eq!(columns("0,5\t1\n1,5\t2\n", "csv", with('\t', ',')).unwrap().1, [[0.5, 1.5], [1.0, 2.0]]);
    }

    #[test]
    fn a_row_of_numbers_is_a_channel_whatever_stands_between_them() {
        let default = TextFormat::default();
        for (text, ending) in
            [("1,2.5,-3\n", "csv"), ("# made\n1 2.5\t-3", "txt"), ("1\t2.5\t-3\n", "tsv"), ("1 2.5 -3\n", "39")]
        {
            assert_eq!(columns(text, ending, default).unwrap(), (Vec::new(), vec![vec![1.0, 2.5, -3.0]]), "{text}");
        }
        // Two rows are two channels, unless a heading says what stands below it.
        assert_eq!(columns("1,2,3\n4,5,6\n", "csv", default).unwrap().1, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(columns("a,b,c\n1,2,3\n4,5,6\n", "csv", default).unwrap().1.len(), 3);
    }

    #[test]
    fn clocks_as_text_are_columns_without_numbers() {
        let text = "at,day,acc\n2021-03-01 12:00:00.002,01/03/2021,1.5\n2021-03-01 12:00:00.003,01/03/2021,-2\n";
        let (names, columns) = columns(text, "csv", TextFormat::default()).unwrap();
        assert_eq!((names, &columns[2][..]), (["at", "day", "acc"].map(str::to_owned).to_vec(), &[1.5, -2.0][..]));
        assert!(columns[..2].iter().flatten().all(|value| value.is_nan()));
        // A date alone stands before the numbers, and a word is none.
        assert_eq!(self::columns("12:00:00\n1\n2\n", "csv", TextFormat::default()).unwrap().1, [[1.0, 2.0]]);
        assert!(self::columns("1,2\n1,x\n", "csv", TextFormat::default()).is_err());
    }

    #[test]
    fn not_a_number_is_read_as_such_and_left_to_the_recordings_check() {
        assert!(columns("1\nNaN\n3\n", "csv", TextFormat::default()).unwrap().1[0][1].is_nan());
    }
}
