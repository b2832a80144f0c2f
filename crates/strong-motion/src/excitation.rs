//! The ground motion of a case: a record, its scale, and how much of it is used.

use crate::{ReadOptions, Source, VerticalFrom};
use crate::{Record, RecordError};
use files::message::{printable, significant};

/// A record as it was read, and what is made of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    /// The whole record, unscaled.
    pub record: Record,
    /// Factor on its acceleration.
    pub scale: f64,
    /// Length asked for (s); the whole record unless given.
    pub duration_s: Option<f64>,
}

/// The ground motion of a record at a scale and as long as asked for. Of a record that was scaled
/// or cut it is that of the whole one, unscaled.
pub fn of_record(record: Record, scale: f64, duration_s: Option<f64>) -> Excitation {
    let Some(made_of) = record.made_of.as_deref() else {
        return Excitation { record, scale, duration_s };
    };
    let shorter = made_of.duration_s.into_iter().chain(duration_s).reduce(f64::min);
    Excitation { record: made_of.record.clone(), scale: scale * made_of.scale, duration_s: shorter }
}

/// A vertical component that is left out, beside the horizontal one: peaks of the whole file,
/// scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerticalLeftOut {
    /// Its peak (g).
    pub peak_g: f64,
    /// Peak of the horizontal motion (g).
    pub horizontal_g: f64,
}

impl Excitation {
    /// A record as it is.
    pub fn whole(record: Record) -> Self {
        Self { record, scale: 1.0, duration_s: None }
    }

    /// The whole record, scaled.
    ///
    /// # Errors
    /// The scale is not finite, or takes the peak above 50 g.
    pub fn scaled(&self) -> Result<Record, RecordError> {
        if self.scale == 1.0 { Ok(self.record.clone()) } else { self.record.scaled(self.scale) }
    }

    /// Length used (s): the one asked for, at most the whole record, at least one time step.
    pub fn duration(&self) -> f64 {
        let whole = self.record.duration();
        self.duration_s.map_or(whole, |asked| asked.min(whole)).max(self.record.dt)
    }

    /// The part used, scaled.
    ///
    /// # Errors
    /// A scale that is not finite, or takes the peak above 50 g.
    pub fn used(&self) -> Result<Record, RecordError> {
        Ok(self.scaled()?.truncated(self.duration()))
    }

    /// The vertical component that the record's file has and that is not used; `None` if there is
    /// none, or if it is used.
    #[doc(hidden)]
    pub fn vertical_left_out(&self) -> Option<VerticalLeftOut> {
        let Source::File { vertical_left_out_g: Some(peak_g), .. } = self.record.source else {
            return None;
        };
        let scale = self.scale.abs();
        let left_out =
            VerticalLeftOut { peak_g: scale * peak_g, horizontal_g: scale * self.record.pga_g() };
        self.record.vertical.is_none().then_some(left_out)
    }

    /// The same ground motion with the vertical component of the record's file, which is read
    /// again; `None` if that is not left out.
    ///
    /// # Errors
    /// The file cannot be read any more, or has several vertical components.
    #[doc(hidden)]
    pub fn with_vertical_left_out(&self) -> Option<Result<Self, RecordError>> {
        self.vertical_left_out()?;
        let Source::File { path, units, component, baseline, .. } = &self.record.source else {
            return None;
        };
        let options = ReadOptions {
            dt: Some(self.record.dt),
            units: Some(*units),
            component: component.clone(),
            baseline: *baseline,
            vertical: Some(VerticalFrom::Auto),
        };
        Some(Record::read(path, &options).map(|record| Self { record, ..self.clone() }))
    }

    /// One line: which record, from where, its scale, how much of it, and the peak of that part.
    #[doc(hidden)]
    pub fn line(&self) -> String {
        let from = match &self.record.source {
            crate::Source::File { path, units, .. } => {
                format!("{}, in {units}", printable(&path.display().to_string()))
            }
            crate::Source::Embedded => "embedded".into(),
            crate::Source::Numbers | crate::Source::Synthetic | crate::Source::Earthquake => {
                "from no file".into()
            }
        };
        let samples = self.record.truncated(self.duration()).len();
        let step = self.record.dt;
        let peak = self.record.truncated(self.duration()).pga_time();
        let when = format!(" at {} s", seconds(peak));
        self.told(&from, &format!(": {samples} samples of {step} s"), &when, false)
    }

    /// The same, shorter: without the file's path, the number of samples, and when the peak is; of
    /// no number more than four digits.
    #[doc(hidden)]
    pub fn short_line(&self) -> String {
        let from = match &self.record.source {
            crate::Source::File { units, .. } => units.to_string(),
            _ => "embedded".into(),
        };
        self.told(&from, &format!(", step {} s", self.record.dt), "", true)
    }

    fn told(&self, from: &str, samples: &str, when: &str, short: bool) -> String {
        let whole = &self.record;
        let used = whole.truncated(self.duration());
        let time = |record: &Record| match short {
            true => significant(record.duration(), 4),
            false => seconds(record.duration()).to_string(),
        };
        let part = match used.len() < whole.len() {
            true if short => format!("{} of {} s", time(&used), time(whole)),
            true => format!("first {} s of {} s", time(&used), time(whole)),
            false => format!("all {} s", time(whole)),
        };
        let peak = |g: f64| match g * self.scale.abs() {
            g if short => significant(g, 4),
            g => format!("{g:.4}"),
        };
        let vertical = used.vertical.as_ref().map_or_else(String::new, |up| {
            format!("; vertical {}, peak {} g", up.name, peak(up.peak_g()))
        });
        format!(
            "record {} ({from}), scale {}, {part}{samples}, PGA {} g{when}{vertical}",
            whole.name,
            self.scale,
            peak(used.pga_g())
        )
    }
}

/// Seconds without the rounding of n dt.
fn seconds(t: f64) -> f64 {
    (t * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Record {
        Record::new("ramp", 0.1, (0..=40).map(|i| 0.05 * f64::from(i)).collect()).unwrap()
    }

    #[test]
    fn a_record_is_used_whole_and_as_it_is_unless_asked_otherwise() {
        let all = Excitation::whole(ramp());
        assert_eq!((all.used().unwrap(), all.duration()), (ramp(), 4.0));
        let part = Excitation { scale: -2.0, duration_s: Some(1.0), ..all.clone() };
        assert_eq!(part.used().unwrap(), ramp().truncated(1.0).scaled(-2.0).unwrap());
        assert_eq!(Excitation { duration_s: Some(9.0), ..all.clone() }.used().unwrap(), ramp());
        assert!(Excitation { scale: f64::NAN, ..all }.used().is_err());
    }

    #[test]
    fn no_number_of_the_short_line_has_more_than_four_digits() {
        let record = Record::new("ramp", 0.02, (0..8192).map(|i| 0.002 * f64::from(i)).collect());
        let all = Excitation { duration_s: Some(80.0), ..Excitation::whole(record.unwrap()) };
        assert_eq!(
            all.short_line(),
            "record ramp (embedded), scale 1, 80 of 163.8 s, step 0.02 s, PGA 0.8155 g"
        );
        let strong = Excitation { scale: 2.0, ..all };
        assert!(strong.short_line().ends_with("PGA 1.631 g"), "{}", strong.short_line());
    }

    #[test]
    fn the_line_tells_a_cut_and_the_peak_of_the_part_used() {
        let all = Excitation::whole(ramp());
        assert_eq!(
            all.line(),
            "record ramp (from no file), scale 1, all 4 s: 41 samples of 0.1 s, PGA 0.2039 g at 4 s"
        );
        let el_centro = Excitation {
            duration_s: Some(1.5),
            scale: 2.0,
            ..Excitation::whole(Record::el_centro())
        };
        let line = el_centro.line();
        assert!(
            line.starts_with(
                "record IELC180 (embedded), scale 2, first 1.5 s of 39.94 s: 151 samples"
            ),
            "{line}"
        );
        let pga = el_centro.used().unwrap().pga_g();
        assert!(
            line.contains(&format!("PGA {pga:.4} g at "))
                && pga < 2.0 * Record::el_centro().pga_g(),
            "{line}"
        );
    }
}
