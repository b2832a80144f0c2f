//! Largest displacements on the screen.

use super::{Crowding, WIDTH};
use crate::{
    Table,
    displacements::{DRIFT_RATIO, FRICTION, LARGEST, PART},
};

/// The row of the table of peaks that gives its line to warnings.
const IMPACTS: &str = "impacts";
/// The table of peaks without what the report alone has; the friction needed stands behind the
/// impacts, outside of the columns, if there is room for both; where these have no line of their
/// own, both stand behind the last row.
pub(super) fn of_screen(
    mut table: Table,
    Crowding { all_peaks, tight, .. }: Crowding,
) -> Vec<String> {
    let friction = table.rows.pop_if(|row| row.first().is_some_and(|name| name == FRICTION));
    // all parts of the top's displacement, or none: they are its sum
    let parts = if tight { parts_in_one_line(&table) } else { None };
    let first_to_go =
        |name: &str| parts.is_some() && [PART, DRIFT_RATIO].iter().any(|p| name.starts_with(p));
    let left_out = |name: &str| {
        name.starts_with(LARGEST) || (!all_peaks && name.starts_with(IMPACTS)) || first_to_go(name)
    };
    let impacts = table.rows.iter().find(|row| row[0].starts_with(IMPACTS) && !all_peaks);
    let impacts = impacts.map(|row| {
        let counts = row[1..].iter().filter(|cell| !cell.is_empty());
        let name = row[0].split(" (").next().unwrap_or(IMPACTS);
        format!("{name}: {}; ", counts.cloned().collect::<Vec<_>>().join(", "))
    });
    table.rows.retain(|row| !left_out(&row[0]));
    let mut lines = table.lines();
    // below the head and the displacement
    parts.into_iter().for_each(|parts| lines.insert(lines.len().min(2), parts));
    let Some(friction) = friction else { return lines };
    let friction = impacts.clone().unwrap_or_default() + &friction[..2].join(": ");
    let room = |line: &&mut String| line.chars().count() + 3 + friction.chars().count() <= WIDTH;
    let behind = |line: &&mut String| line.starts_with(IMPACTS) || impacts.is_some();
    match lines.last_mut().filter(behind).filter(room) {
        Some(line) => *line += &format!(";  {friction}"),
        None => lines.push(friction),
    }
    lines
}

/// Parts of the top's displacement on springs in a line; none of a rigid body.
fn parts_in_one_line(table: &Table) -> Option<String> {
    let part = |row: &Vec<String>| {
        let name = row[0].strip_prefix(PART)?.trim_start();
        Some(format!("{} {}", name.strip_prefix("by ").unwrap_or(name), row[2]))
    };
    let parts: Vec<String> = table.rows.iter().filter_map(part).collect();
    (!parts.is_empty()).then(|| format!("{PART} on springs: {}", parts.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::{
        super::{CLOSEST, SPACIOUS},
        *,
    };

    /// Where it is crowded, impacts have no line of their own, but are told.
    #[test]
    fn impacts_are_told_however_little_room_there_is() {
        let row = |cells: [&str; 4]| cells.map(String::from).to_vec();
        let table = || {
            Table::new(["largest", "Housner", "on springs", ""]).with([
                row(["uplift", "104.3 mm", "104.3 mm", "-0.002 %"]),
                row(["impacts (above 0.02 alpha)", "1", "2", ""]),
                row([FRICTION, "0.307", "", ""]),
            ])
        };
        let crowded = of_screen(table(), Crowding { all_peaks: false, ..CLOSEST });
        assert_eq!(crowded.len(), 2, "{crowded:?}");
        let told = "-0.002 %;  impacts: 1, 2; friction needed: 0.307";
        assert!(crowded[1].ends_with(told), "{crowded:?}");
        let spacious = of_screen(table(), SPACIOUS);
        assert!(spacious[2].starts_with("impacts (above") && spacious.len() == 3, "{spacious:?}");
    }

    /// Where it is crowded, parts of the top's displacement stand in one line, and are all of it.
    #[test]
    fn parts_of_a_displacement_are_all_told_or_none() {
        let row = |name: &str, x: &str| vec![name.into(), "-".into(), x.to_string(), "-".into()];
        let rows = || {
            [
                row("top displacement", "126.5 mm*"),
                row("  of it by rocking", "91.2 mm*"),
                row("  of it by bending", "-13.41 mm*"),
                row("  of it by moved feet", "48.71 mm*"),
                row("uplift", "81.35 mm*"),
            ]
        };
        let table = || Table::new(["largest", "rigid ground", "on springs", ""]).with(rows());
        let all = of_screen(table(), SPACIOUS);
        assert_eq!(all.iter().filter(|line| line.starts_with(PART)).count(), 3, "{all:?}");
        let few = of_screen(table(), Crowding { tight: true, ..CLOSEST });
        let said = "  of it on springs: rocking 91.2 mm*, bending -13.41 mm*, moved feet 48.71 mm*";
        assert_eq!((few.len(), few[2].as_str()), (4, said), "{few:?}");
    }
}
