//! `tune sweep`: what its summary and tables say of small sweeps whose answers are known.

#[path = "support/program.rs"]
mod program;

use program::TestFolder;

/// A folder in which a sweep ran, and its summary.
struct SweepRun {
    dir: TestFolder,
    summary: String,
}

impl SweepRun {
    fn new(spec: &str, record: &str) -> Self {
        let dir = TestFolder::with(&[("sweep.toml", spec), ("record.csv", record)]);
        dir.runs("sweep sweep.toml --out out --quiet");
        let summary = dir.text("out/summary.md");
        Self { dir, summary }
    }

    fn says(&self, words: &str) {
        assert!(self.summary.contains(words), "{words}\n{}", self.summary);
    }

    fn does_not_say(&self, words: &str) {
        assert!(!self.summary.contains(words), "{words}\n{}", self.summary);
    }

    fn shows(&self, figure: &str, words: &str) {
        let drawn = self.dir.text(&format!("out/{figure}"));
        assert!(drawn.lines().any(|line| line == words), "{words} is not in {figure}");
    }

    /// The numbers of a column of a table.
    fn column(&self, table: &str, name: &str) -> Vec<f64> {
        let text = self.dir.text(&format!("out/{table}"));
        let mut lines = text.lines();
        let place = lines.next().unwrap().split(',').position(|head| head == name).unwrap();
        // commas in names stand between quotation marks
        let cells = |line: &str| {
            let plain: Vec<&str> = line.split('"').step_by(2).collect();
            plain.concat().split(',').nth(place).unwrap().parse().unwrap_or(f64::NAN)
        };
        lines.map(cells).collect()
    }
}

const BLOCK: &str = "[[structure]]
kind = \"block\"
total_height_m = 2.0
width_m = 0.5
mass_kg = 400.0
";

/// Acceleration (m/s2) at steps of 0.01 s up to 2 s, as a table.
fn record(accel: impl Fn(f64) -> f64) -> String {
    (0..=200).fold(String::new(), |text, i| {
        let t = 0.01 * f64::from(i);
        text + &format!("{t:.2},{:.9}\n", accel(t))
    })
}

/// a = 0.2 + 3 sin(pi t), t up to 2 s: less its mean it gives v = 3/pi (1 - cos(pi t)), which in
/// the first half second reaches 3/pi. The first half second alone has another mean.
#[test]
fn pgv_of_the_first_part_of_a_record_is_that_of_the_whole_record_up_to_there() {
    use std::f64::consts::PI;
    for (duration, pgv) in [("", 6.0 / PI), ("duration_s = 0.5", 3.0 / PI)] {
        let spec = format!(
            "[sweep]\nkind = \"fragility\"\n{BLOCK}[records]\nfiles = [\"record.csv\"]\n\
             units = \"m/s2\"\n{duration}\n[levels]\nscale = [1.0]\n"
        );
        let ran = SweepRun::new(&spec, &record(|t| 0.2 + 3.0 * (PI * t).sin()));
        let found = ran.column("histories.csv", "pgv_m_per_s")[0];
        assert!((found / pgv - 1.0).abs() < 2e-4, "{duration}: {found}, {pgv}");
    }
}

/// A fragility sweep of one block.
fn fragility(records: &str, levels: &str) -> SweepRun {
    let spec =
        format!("[sweep]\nkind = \"fragility\"\n{BLOCK}[records]\n{records}\n[levels]\n{levels}\n");
    SweepRun::new(&spec, &record(|t| 4.0 * (4.0 * t).sin()))
}

const LEVELS: &str = "pga_g = { from = 0.2, to = 2.0, count = 60 }";

#[test]
fn one_record_gives_no_bounds_and_is_not_called_half_of_the_motions() {
    let one = fragility("el_centro = true", LEVELS);
    one.says("one record gives no bounds: the fit to its levels is 0.5 at PGA = ");
    one.says("One record says nothing of other motions: take more.");
    one.does_not_say("half of the motions");
    assert!(one.column("fragility.csv", "median").iter().any(|x| x.is_finite()));
    assert!(one.column("fragility.csv", "median_low").iter().all(|x| x.is_nan()));
    let separated = fragility("el_centro = true", "pga_g = [0.1, 3.0]");
    separated.says("the one motion leaves it standing up to PGA = 0.100 g and overturns it from");
    separated.does_not_say("alone decides");
    // each motion that is made is a record
    fragility("synthetic = 12", LEVELS).says("% bounds");
}

/// The same record twice: both say the same, and the fit is there.
#[test]
fn a_fit_of_records_that_do_not_differ_is_told_without_bounds() {
    let twice = fragility("files = [\"record.csv\", \"record.csv\"]\nunits = \"m/s2\"", LEVELS);
    println!("{}", twice.summary);
    twice.says("the 2 records do not differ, so there are no bounds");
    twice.does_not_say("higher levels overturn it less often");
}

/// Three blocks of one shape: equation 2's restitution is 1 - 3/2 sin^2(alpha), alpha = atan(1/4),
/// so 1 - 3/34.
#[test]
fn structures_of_one_shape_are_told_apart_by_their_restitution() {
    let spec = |more: &str| {
        format!(
            "[sweep]\nkind = \"fragility\"\n{more}\n{BLOCK}{BLOCK}restitution = 0.72\n{BLOCK}\
             [records]\nel_centro = true\n[levels]\npga_g = [0.5]\n"
        )
    };
    let own = SweepRun::new(&spec(""), "");
    let name = "- block R 1.031 m, alpha 0.245";
    own.says(&format!("{name}, e = 0.9118 (equation 2), by"));
    own.says(&format!("{name}, e = 0.72, by"));
    own.says(&format!("{name}, e = 0.9118 (equation 2), number 2, by"));
    let same = SweepRun::new(&spec("restitution = 0.9"), "");
    same.says(&format!("{name}, e = 0.9, by"));
    same.says(&format!("{name}, number 2, e = 0.9, by"));
    same.does_not_say("equation 2");
    own.shows("ida.svg", "block R 1.031 m, alpha 0.245, e = 0.72");
    // one alone, too
    let alone = format!(
        "[sweep]\nkind = \"fragility\"\n{BLOCK}restitution = 0.5\n[records]\nel_centro = true\n\
         [levels]\npga_g = [0.5]\n"
    );
    SweepRun::new(&alone, "").says(&format!("{name}, e = 0.5, by"));
    SweepRun::new(&spec("restitution = [0.9, 0.8]"), "")
        .shows("ida.svg", "Peak rotation against PGA [g], 1 motion, e = 0.9");
}

#[test]
fn a_structure_has_the_name_that_its_user_gives() {
    let spec = format!(
        "[sweep]\nkind = \"fragility\"\n{BLOCK}name = \"cabinet <1>, \\\"left\\\"\"\n{BLOCK}\
         [records]\nel_centro = true\n[levels]\npga_g = [0.5]\n"
    );
    let ran = SweepRun::new(&spec, "");
    ran.says("- cabinet <1>, \"left\", by Housner's equation");
    ran.says("- block R 1.031 m, alpha 0.245, by Housner's equation");
    ran.shows("ida.svg", "cabinet &lt;1&gt;, &quot;left&quot;");
    let table = ran.dir.text("out/ida.csv");
    assert!(table.contains("\"cabinet <1>, \"\"left\"\"\""), "{table}");
}

/// Two blocks of alpha atan(1/4) and atan(1/2), of one size: the slender one overturns from the
/// least PGA, and which has the least PGA/(g tan alpha) is in the table.
#[test]
fn the_least_pulse_is_told_in_both_measures_with_the_restitution() {
    let wide = BLOCK.replace("width_m = 0.5", "width_m = 1.0");
    let spec = format!(
        "[sweep]\nkind = \"overturning\"\nrestitution = [0.8, 0.95]\n{BLOCK}{wide}[[pulse]]\n\
         shape = \"sine\"\nomega_over_p = [0.8, 3.0]\n[levels]\n\
         pga_over_uplift = {{ from = 0.9, to = 4.0, count = 80 }}\n"
    );
    let ran = SweepRun::new(&spec, "");
    let [from, alpha, e] = ["from_over_uplift", "alpha", "restitution"]
        .map(|name| ran.column("overturning.csv", name));
    let least = |of: &dyn Fn(usize) -> f64| {
        (0..from.len()).min_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap()
    };
    let in_g = |row: usize| from[row] * alpha[row].tan();
    let (a, b) = (least(&|row| from[row]), least(&in_g));
    assert!(a != b && (alpha[b].tan() - 0.25).abs() < 1e-9, "{}", alpha[b]);
    for (what, row) in [("PGA/(g tan alpha)", a), ("PGA", b)] {
        let peaks = format!("PGA = {:.4} g, {:.4} g tan(alpha), sine", in_g(row), from[row]);
        ran.says(&format!("Least {what} that overturns: {peaks}"));
        ran.says(&format!(", e = {}.", e[row]));
    }
    ran.shows("overturning.svg", "Pulses that overturn, 2 structures, e = 0.8");
    ran.shows("overturning.svg", "block R 1.118 m, alpha 0.4636");
}

#[test]
fn springs_that_do_not_reach_their_accuracy_are_named_once_in_the_summary() {
    let spec = format!(
        "[sweep]\nkind = \"fragility\"\nmodel = \"both\"\nrestitution = [0.9]\n{BLOCK}[records]\n\
         el_centro = true\n[levels]\npga_g = [0.4]\n[springs]\naccuracy = 0.001\n\
         max_omega_hz = 20.0\n"
    );
    let ran = SweepRun::new(&spec, "");
    let words = "CHECK springs for restitution 0.9, tuned on block R 1.031 m, alpha 0.245: they do \
                 not reach the accuracy of 0.001;";
    assert_eq!(ran.summary.matches(words).count(), 1, "{}", ran.summary);
}

/// One motion of two has a vertical component; a body is lifted at g tan(alpha) without it alone.
#[test]
fn a_summary_tells_of_vertical_motion_and_of_friction() {
    let files = format!("files = [{:?}]\nel_centro = true", program::TE_MARA);
    let friction = "friction coefficient of at least b/h = tan(alpha): 0.250. With less it slides";
    let up = fragility(&format!("{files}\nvertical = \"auto\""), "pga_g = [0.5]");
    up.says("Motions with a vertical component: 1 of 2; the others are horizontal.");
    up.says("  Without vertical motion it lifts at PGA = g tan(alpha) = 0.250 g.");
    up.says(friction);
    let across = fragility("el_centro = true", "pga_g = [0.5]");
    across.says("  It lifts at PGA = g tan(alpha) = 0.250 g.");
    across.says(friction);
    across.does_not_say("vertical");
    across.does_not_say("spread evenly");
    let levels = "pga_g = { from = 0.2, to = 2.0, count = 12, spacing = \"log\" }";
    fragility("el_centro = true", levels)
        .says("10 of its 12 levels, spread evenly; ida.csv has all");
}

/// El Centro at five times overturns a block that lifts at 0.25 g, a push of 0.01 g does not lift
/// it: half of the motions overturn it, which the table's median tells as inf.
#[test]
fn a_rocking_sweep_counts_histories_and_names_what_half_of_the_motions_overturn() {
    let spec = format!(
        "[sweep]\nkind = \"rocking\"\n{BLOCK}[records]\nel_centro = true\n\
         files = [\"record.csv\"]\nunits = \"m/s^2\"\n[levels]\nscale = [5.0]\n"
    );
    let ran = SweepRun::new(&spec, &record(|t| 0.02 * (4.0 * t).sin()));
    ran.says(
        "Of 2 histories 50.0 % never lift the body, 0.0 % rock it without overturning it, 50.0 %",
    );
    ran.says("The largest body that at least half of the motions overturn: block R 1.031 m");
    ran.does_not_say("come to rest");
    assert_eq!(ran.column("rocking.csv", "peak_50"), [f64::INFINITY]);
}

/// Six structures have a panel, and at most thirty motions a line.
#[test]
fn figures_tell_how_many_structures_and_motions_they_show() {
    let blocks: String = (0..7).map(|i| BLOCK.replace("= 2.0", &format!("= 2.{i}"))).collect();
    let spec = format!(
        "[sweep]\nkind = \"fragility\"\n{blocks}[records]\nearthquakes = 31\n[levels]\n\
         pga_g = {{ from = 0.2, to = 2.0, count = 8 }}\n"
    );
    let ran = SweepRun::new(&spec, "");
    ran.shows(
        "ida.svg",
        "Peak rotation against PGA [g], 31 motions (16 as grey lines), 6 of 7 structures",
    );
    ran.shows("fragility_structures.svg", "Overturning of 6 of 7 structures, 31 motions, Housner");
}

#[test]
fn a_case_given_as_a_sweep_is_named_as_what_it_is() {
    let case = BLOCK.replace("[[structure]]", "[structure]");
    let told =
        TestFolder::with(&[("case.toml", &case)]).refuses("sweep case.toml --out out --quiet");
    assert!(told.contains("this is a case, not a sweep; run it as `tune run case.toml`"), "{told}");
}
