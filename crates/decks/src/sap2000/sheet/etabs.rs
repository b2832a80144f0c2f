//! What ETABS calls by other names than SAP2000, as its maker's help has it (docs/sap2000.md).

use super::{SapModel, number};

/// Where in ETABS what follows is set.
pub(super) fn words(parts: &SapModel) -> String {
    let lowest = parts.feet.iter().map(|foot| parts.place(foot.joint)[1] - 2.0 * parts.link);
    let lowest = number(lowest.fold(f64::INFINITY, f64::min));
    format!(
        "ETABS reads no .s2k file. A model in a plane: Analyze > Set Active Degrees of Freedom, XZ \
         Plane. The base\nof the stories at z = {lowest} m, the lowest joint, or below. Links: \
         Define > Section Properties > Link/Support\nProperties, types Friction Isolator and \
         Linear. Load cases: nonlinear static; time history, nonlinear direct\nintegration. ETABS \
         was not run.\n"
    )
}
