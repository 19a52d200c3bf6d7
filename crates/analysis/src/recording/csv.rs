//! Recordings as text: numbers in columns.
//!
//! Columns are parted by semicolons, tabs, commas or blanks, whichever of these, in this order, the first row of
//! numbers has; where that is not the comma, a comma in a number is its decimal point. Lines before the first that
//! begins with a number are a preamble, and the last of them with as many cells is the heading. Lines that begin with
//! # or % are comments.
//!
//! What can be read in two ways is refused: points and commas in numbers of one file, commas and blanks that may part
//! thousands, and `1,5` alone on its line, unless other lines tell whether it is one number or two.

/// Lines of preamble after which the file is taken for something else.
const LONGEST_PREAMBLE: usize = 100;

/// Headings, empty where there are none, and columns.
pub(crate) type Columns = (Vec<String>, Vec<Vec<f64>>);

/// A line and its number, from 1.
type Line<'a> = (usize, &'a str);

/// The columns of a text.
pub(crate) fn columns(text: &str) -> Result<Columns, String> {
    let lines: Vec<Line> = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim_start_matches('\u{feff}').trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with(['#', '%']))
        .collect();
    let first = lines
        .iter()
        .take(LONGEST_PREAMBLE)
        .position(|(_, line)| begins_with_number(line))
        .ok_or_else(|| format!("no line of numbers among the first {LONGEST_PREAMBLE}"))?;
    let (preamble, rows) = lines.split_at(first);
    let delimiter = delimiter(preamble, rows)?;
    let width = cells(rows[0].1, delimiter).len();
    let heading = preamble.iter().rev().map(|(_, line)| cells(line, delimiter)).find(|c| c.len() == width);
    if delimiter == ' ' && width > 1 && heading.is_none() {
        thousands_by_blanks(rows)?;
    }
    let names = heading.unwrap_or_default().into_iter().map(|name| name.trim_matches('"').trim().to_owned()).collect();
    let mut columns = vec![Vec::with_capacity(rows.len()); width];
    let mut decimals = Decimals::default();
    for &(number, line) in rows {
        let cells = cells(line, delimiter);
        if cells.len() != width {
            return Err(format!("line {number}: {} columns, the first row of numbers has {width}", cells.len()));
        }
        for (column, cell) in columns.iter_mut().zip(cells) {
            if delimiter != ',' {
                decimals.see(cell, number)?;
            }
            column.push(value(cell, delimiter).ok_or_else(|| format!("line {number}: '{cell}' is not a number"))?);
        }
    }
    decimals.check()?;
    Ok((names, columns))
}

/// Refuses rows like `2 261,5` that no heading tells to be two numbers: blanks may part thousands.
fn thousands_by_blanks(rows: &[Line]) -> Result<(), String> {
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let group = |cell: &str| {
        let whole = cell.split([',', '.']).next().unwrap_or_default();
        whole.len() == 3 && digits(whole)
    };
    let grouped = |line: &str| {
        let mut cells = line.split_whitespace();
        let first = cells.next().unwrap_or_default().trim_start_matches(['-', '+']);
        (1..=3).contains(&first.len()) && digits(first) && cells.all(group)
    };
    if !rows.iter().all(|(_, line)| grouped(line)) {
        return Ok(());
    }
    let (number, line) = rows[0];
    Err(format!(
        "line {number}: '{line}': blanks may part thousands or columns: write numbers without them, or name the columns"
    ))
}

fn begins_with_number(line: &str) -> bool {
    let end = line.find([';', '\t', ' ']).unwrap_or(line.len());
    // With a comma the cell may end there, or be a number with a decimal comma.
    let cell = line[..end].trim_end_matches(',');
    let mut parts = cell.split(',');
    let whole = parts.next().unwrap_or_default();
    // Some leave the nought before the comma out.
    let fraction_alone =
        matches!(whole, "" | "-" | "+") && parts.next().is_some_and(|part| part.parse::<u64>().is_ok());
    whole.parse::<f64>().is_ok() || fraction_alone
}

/// What parts the columns. A blank also stands for one column alone.
fn delimiter(preamble: &[Line], rows: &[Line]) -> Result<char, String> {
    let first = rows[0].1;
    if let Some(delimiter) = [';', '\t'].into_iter().find(|&d| first.contains(d)) {
        return Ok(delimiter);
    }
    // Every comma inside a number, and blanks between them.
    let parted_by_blanks = |line: &str| line.contains(' ') && line.split_whitespace().all(is_decimal);
    if !first.contains(',') || parted_by_blanks(first) {
        return Ok(' ');
    }
    one_meaning_of_commas(rows)?;
    if one_number_a_line(preamble, rows)? { Ok(' ') } else { Ok(',') }
}

/// A number with at most one comma, and digits on both sides of it.
fn is_decimal(cell: &str) -> bool {
    match cell.split_once(',') {
        None => cell.parse::<f64>().is_ok(),
        Some((whole, fraction)) => {
            whole.ends_with(|c: char| c.is_ascii_digit())
                && fraction.starts_with(|c: char| c.is_ascii_digit())
                && !fraction.contains(',')
                && format!("{whole}.{fraction}").parse::<f64>().is_ok()
        }
    }
}

/// Refuses rows like `0,000,1,25`, in which commas part both numbers and their decimals: nobody prints a number as 000.
fn one_meaning_of_commas(rows: &[Line]) -> Result<(), String> {
    let decimals = |cell: &str| cell.len() > 1 && cell.starts_with('0') && cell.bytes().all(|b| b.is_ascii_digit());
    let twice =
        |line: &str| !line.contains('.') && line.matches(',').count() > 1 && line.split(',').skip(1).any(decimals);
    match rows.iter().find(|(_, line)| twice(line)) {
        None => Ok(()),
        Some((number, line)) => Err(format!(
            "line {number}: '{line}': commas seem to part numbers and their decimals alike: part columns by \
             semicolons, or write decimal points"
        )),
    }
}

/// Whether rows like `0,125` are one number with a decimal comma each, or numbers parted by commas.
fn one_number_a_line(preamble: &[Line], rows: &[Line]) -> Result<bool, String> {
    let last = rows[rows.len() - 1].0;
    let (mut one, mut several) = (None, preamble.iter().rev().find(|(_, line)| cells(line, ',').len() == 2).copied());
    for &(number, line) in rows {
        let (whole, rest) = line.split_once(',').unwrap_or((line, ""));
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let (mantissa, exponent) = rest.split_once(['e', 'E']).unwrap_or((rest, "0"));
        let unlike_decimals = !digits(mantissa) || exponent.parse::<i32>().is_err() || whole.contains(['.', 'e', 'E']);
        // 05 or -0 as a number of its own, or 123e4, are nowhere printed. The last line may be cut off.
        let like_decimals = (mantissa.len() > 1 && (mantissa.starts_with('0') || mantissa != rest))
            || matches!(whole, "" | "-" | "+" | "-0" | "+0")
            || (rest.is_empty() && number != last && is_decimal(line));
        if line.contains(',') && unlike_decimals {
            several = several.or(Some((number, line)));
        } else if like_decimals {
            one = one.or(Some((number, line)));
        }
    }
    match (one, several) {
        (Some(_), None) => Ok(true),
        (None, Some(_)) => Ok(false),
        (None, None) => Err(format!(
            "line {}: '{}' is one number with a decimal comma, or two: put names above two columns, or write decimal \
             points",
            rows[0].0, rows[0].1
        )),
        (Some((number, line)), Some((other, unlike))) => Err(format!(
            "line {number}: '{line}' looks like one number with a decimal comma, line {other}, '{unlike}', like \
             several: part columns by semicolons, or write decimal points"
        )),
    }
}

fn cells(line: &str, delimiter: char) -> Vec<&str> {
    if delimiter == ' ' {
        return line.split_whitespace().collect();
    }
    let mut cells: Vec<&str> = line.split(delimiter).map(str::trim).collect();
    // Some programs end every line with a delimiter.
    if cells.len() > 1 && cells.last() == Some(&"") {
        cells.pop();
    }
    cells
}

fn value(cell: &str, delimiter: char) -> Option<f64> {
    let decimal_comma = delimiter != ',' && cell.contains(',');
    if decimal_comma { cell.replace(',', ".").parse().ok() } else { cell.parse().ok() }
}

/// How the numbers of a file have their decimals, where commas do not part columns.
#[derive(Debug, Default)]
struct Decimals {
    /// First line with a decimal point.
    point: Option<usize>,
    /// First line with a comma.
    comma: Option<usize>,
    /// First number with a comma, while all of them might be whole ones with thousands parted.
    thousands: Option<(usize, String)>,
    /// Whether a number showed that commas are decimal.
    decimal: bool,
}

impl Decimals {
    fn see(&mut self, cell: &str, line: usize) -> Result<(), String> {
        if let Some((whole, fraction)) = cell.split_once(',') {
            self.comma.get_or_insert(line);
            let whole = whole.trim_start_matches(['-', '+']);
            let parts_thousands = (1..=3).contains(&whole.len()) && !whole.starts_with('0') && fraction.len() == 3;
            self.decimal |= !parts_thousands;
            if self.thousands.is_none() && !self.decimal {
                self.thousands = Some((line, cell.to_owned()));
            }
        } else if cell.contains('.') {
            self.point.get_or_insert(line);
        }
        match (self.point, self.comma) {
            (Some(point), Some(comma)) => Err(format!(
                "line {line}: '{cell}': line {point} has a decimal point and line {comma} a comma in a number: one of \
                 both is needed"
            )),
            _ => Ok(()),
        }
    }

    fn check(&self) -> Result<(), String> {
        match &self.thousands {
            Some((line, cell)) if !self.decimal => Err(format!(
                "line {line}: the comma in '{cell}' is decimal or parts thousands, and no other line tells: write \
                 decimal points"
            )),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delimiters_preambles_headings_and_decimal_commas_are_understood() {
        let expected = vec![vec![0.0, 0.5], vec![1.5, -2.0]];
        for text in [
            "time,acc\n0.0,1.5\n0.5,-2.0\n",
            "\u{feff}time;acc\r\n0,0;1,5\r\n0,5;-2,0\r\n",
            "recorder 7\nrate: fast\n\"time\"\t\"acc\"\n0\t1.5\n0.5\t-2\n",
            "# comment\ntime acc\n0  1.5\n 0.5 -2e0\n",
            "time,acc,\n0.0,1.5,\n0.5,-2.0,\n",
        ] {
            let (names, found) = columns(text).unwrap();
            assert_eq!((names, found), (vec!["time".to_owned(), "acc".to_owned()], expected.clone()), "{text}");
        }
        assert_eq!(columns("1.5\n2.5\n").unwrap(), (Vec::new(), vec![vec![1.5, 2.5]]));
        assert_eq!(columns("0,5\t1\n1,5\t2\n").unwrap().1, [[0.5, 1.5], [1.0, 2.0]]);
    }

    #[test]
    fn blanks_that_may_part_thousands_are_refused() {
        for text in ["acc\n-2 261,5\n-8 779,5\n", "2 261\n8 779\n", "1 234 567,5\n-2 345 678,5\n"] {
            assert!(columns(text).is_err_and(|e| e.contains("line") && e.contains("part thousands")), "{text}");
        }
        // Names, or numbers that no groups of three are, tell that they are columns.
        for text in ["time acc\n1 234\n2 345\n", "0 1234,5\n1 2345,5\n", "0,5 234\n1,5 345\n", "1000 234\n1001 345\n"] {
            assert_eq!(columns(text).unwrap().1.len(), 2, "{text}");
        }
    }

    #[test]
    fn broken_text_is_refused_by_line() {
        assert!(columns("1\n2\nx\n").is_err_and(|e| e.contains("line 3") && e.contains("'x'")));
        assert!(columns("a,b\n1,2\n3\n").is_err_and(|e| e.contains("line 3") && e.contains("1 columns")));
        assert!(columns("").is_err());
        assert!(columns("only words\nand more\n").is_err());
    }

    #[test]
    fn not_a_number_is_read_as_such_and_left_to_the_recordings_check() {
        assert!(columns("1\nNaN\n3\n").unwrap().1[0][1].is_nan());
    }
}
