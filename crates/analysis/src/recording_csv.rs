//! Recordings as text: numbers in columns.
//!
//! Columns are parted by semicolons, tabs, commas or blanks, whichever of these, in this order, the first row of numbers has;
//! where that is not the comma, a comma in a number is its decimal point. Lines before the first that begins with a number are
//! a preamble, and the last of them with as many cells is the heading. Lines that begin with # or % are comments.

/// Lines of preamble after which the file is taken for something else.
const LONGEST_PREAMBLE: usize = 100;

/// Headings, empty where there are none, and columns.
pub(super) type Columns = (Vec<String>, Vec<Vec<f64>>);

/// The columns of a text.
pub(super) fn columns(text: &str) -> Result<Columns, String> {
    let lines: Vec<(usize, &str)> = text
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
    let delimiter = [';', '\t', ','].into_iter().find(|&d| lines[first].1.contains(d)).unwrap_or(' ');
    let width = cells(lines[first].1, delimiter).len();
    let heading = lines[..first].iter().rev().map(|(_, line)| cells(line, delimiter)).find(|c| c.len() == width);
    let names = heading.unwrap_or_default().into_iter().map(|name| name.trim_matches('"').trim().to_owned()).collect();
    let mut columns = vec![Vec::with_capacity(lines.len() - first); width];
    for (number, line) in &lines[first..] {
        let cells = cells(line, delimiter);
        if cells.len() != width {
            return Err(format!("line {number}: {} columns, the first row of numbers has {width}", cells.len()));
        }
        for (column, cell) in columns.iter_mut().zip(cells) {
            column.push(value(cell, delimiter).ok_or_else(|| format!("line {number}: '{cell}' is not a number"))?);
        }
    }
    Ok((names, columns))
}

fn begins_with_number(line: &str) -> bool {
    let end = line.find([';', '\t', ' ']).unwrap_or(line.len());
    // With a comma the cell may end there, or be a number with a decimal comma.
    let cell = line[..end].trim_end_matches(',');
    cell.split(',').next().is_some_and(|part| part.parse::<f64>().is_ok())
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
