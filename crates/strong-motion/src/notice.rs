//! What a reader says aloud of a record that it accepts.

use std::fmt;

use files::message::{significant, with_words_for};

use super::Record;
use super::text::quote;

/// A remark on a record: one line.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum Notice {
    /// The file has several components and none was asked for.
    Taken { file: String, taken: String, pga_g: f64, others: String },
    /// Bare values in several columns are one series.
    RowByRow { file: String, columns: usize, samples: usize },
    /// The times were in ms by the name of their column.
    Milliseconds { file: String, dt: f64 },
    /// The header says another time step than the times have, which are taken.
    OtherStep { file: String, said: f64, dt: f64 },
    /// The file has vertical components alone.
    OnlyVertical { file: String, component: String },
    /// The vertical component goes on after the record's end.
    VerticalCut { file: String, vertical: String, samples: usize },
    /// The mean is a large share of the peak.
    Offset { file: String, component: String, share: f64 },
    /// A peak that few earthquakes reach.
    Strong { file: String, component: String, pga_g: f64 },
    /// A time step that few instruments have.
    Coarse { file: String, component: String, dt: f64 },
    /// A peak velocity that no earthquake reaches.
    Fast { file: String, component: String, pgv: f64 },
    /// A peak below what an instrument in a city resolves.
    Weak { file: String, component: String, pga_g: f64 },
}

impl Notice {
    /// A mean above this share of the peak is said: no ground moves on with such an acceleration.
    pub(crate) const OFFSET_SHARE: f64 = 0.1;
    /// PGA above this is said (g): no earthquake has been recorded with it.
    pub(crate) const STRONG_G: f64 = 5.0;
    /// A time step of this and more is said (s): accelerograms have 0.001 to 0.02 s.
    pub(crate) const COARSE_S: f64 = 0.05;
    /// PGV above this is said (m/s): hardly any earthquake has been recorded with it.
    pub(crate) const FAST_M_PER_S: f64 = 3.0;
    /// PGA below this is said (g).
    pub(crate) const WEAK_G: f64 = 1e-4;
}

/// What the user should know of a record's time step and peaks, whether it is of a file or of
/// numbers; `file` and `component` name it, the latter empty where there is one.
pub fn notices(record: &Record, file: &str, component: &str) -> Vec<Notice> {
    let names = || (file.to_owned(), component.to_owned());
    let mut notices = Vec::new();
    let dt = record.dt;
    if dt >= Notice::COARSE_S * (1.0 - 1e-9) {
        let (file, component) = names();
        notices.push(Notice::Coarse { file, component, dt });
    }
    let pgv = record.measures().pgv.value.abs();
    if pgv > Notice::FAST_M_PER_S {
        let (file, component) = names();
        notices.push(Notice::Fast { file, component, pgv });
    }
    let (pga_g, (file, component)) = (record.pga_g(), names());
    if pga_g > Notice::STRONG_G {
        notices.push(Notice::Strong { file, component, pga_g });
    } else if pga_g > 0.0 && pga_g < Notice::WEAK_G {
        notices.push(Notice::Weak { file, component, pga_g });
    }
    notices
}

/// Names of options in the words of a file that has them as keys of a section.
const OPTIONS: [(&str, &str); 3] =
    [("--component", "component"), ("--column", "component"), ("--baseline", "baseline")];

impl Notice {
    /// The same for who gives keys of a section of a file, not options.
    #[doc(hidden)]
    pub fn with_keys_of(&self, section: &str) -> String {
        OPTIONS.iter().fold(self.to_string(), |told, (option, key)| {
            with_words_for(&told, option, &format!("{key} under [{section}]"))
        })
    }
}

/// "component N28W", or the record where its file names none.
fn who(component: &str) -> String {
    if component.is_empty() { "the record".to_owned() } else { format!("component {component}") }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Taken { file, taken, pga_g, others } => write!(
                f,
                "{file}: component {taken} is taken, the stronger horizontal one ({pga_g:.4} g); \
                 also there: {others}; \
                 choose with --component"
            ),
            Self::RowByRow { file, columns, samples } => write!(
                f,
                "{file}: {columns} columns without times are read row by row, as one series of \
                 {samples} samples; if each \
                 column is a component, choose one with --column"
            ),
            Self::Milliseconds { file, dt } => {
                write!(f, "{file}: times in ms, as their column is named, make a step of {dt} s")
            }
            Self::OtherStep { file, said, dt } => write!(
                f,
                "{file}: the header says a time step of {} s, the times have {dt} s, which is \
                 taken; check which is right",
                significant(*said, 4)
            ),
            Self::OnlyVertical { file, component } => {
                write!(
                    f,
                    "{file}: component {component} is taken as the horizontal motion; the file has \
                     no horizontal one"
                )
            }
            Self::VerticalCut { file, vertical, samples } => write!(
                f,
                "{file}: the vertical component, {}, has {samples} more {} than the record; both \
                    begin together, and what comes after the record is left out",
                quote(vertical),
                if *samples == 1 { "sample" } else { "samples" }
            ),
            Self::Offset { file, component, share } => write!(
                f,
                "{file}: {} has an offset of {:.0} % of its peak; --baseline removes it (not of \
                 a pulse that leaves the ground moving)",
                who(component),
                share * 100.0
            ),
            Self::Strong { file, component, pga_g } => {
                write!(
                    f,
                    "{file}: {} has a peak of {pga_g:.3} g, above 5 g; check the unit",
                    who(component)
                )
            }
            Self::Coarse { file, component, dt } => {
                write!(
                    f,
                    "{file}: {} has a time step of {dt} s, accelerograms have 0.001 to 0.02 s; \
                     check the unit of the times",
                    who(component)
                )
            }
            Self::Fast { file, component, pgv } => {
                write!(
                    f,
                    "{file}: {} has a peak velocity of {pgv:.3} m/s, above 3 m/s; check the unit \
                     and the time step",
                    who(component)
                )
            }
            Self::Weak { file, component, pga_g } => {
                write!(
                    f,
                    "{file}: {} has a peak of {pga_g:.2e} g, below 1e-4 g; check the unit",
                    who(component)
                )
            }
        }
    }
}
