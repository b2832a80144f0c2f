//! A whole record file: its components, and which of them a run takes.

use std::path::Path;

use super::parsed::Channel;
use super::text::{self, quote};
use super::{
    Direction, Notice, Peak, ReadOptions, Record, RecordError, RecordFormat, Source, Units,
    Vertical,
};

/// One component of a file, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// What the file calls it.
    pub name: Option<String>,
    /// Its direction.
    pub direction: Direction,
    /// Unit of the numbers in the file, as it says or as was given.
    pub units: Units,
    /// Time of the first sample on the clock of the header (s): GeoNet's corrected records begin
    /// before zero. Times of the header's peaks are on this clock.
    pub start: f64,
    /// Mean of the samples as read (m/s2); the record still has it unless `baseline` was asked for.
    pub offset: f64,
    /// The header's peak acceleration (m/s2): the samples have it.
    pub header_pga: Option<Peak>,
    /// The header's peak velocity (m/s).
    pub header_pgv: Option<Peak>,
    /// Its samples.
    pub record: Record,
}

/// A record file with all its components.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The file's format.
    pub format: RecordFormat,
    /// Station or site, as the file names it.
    pub station: Option<String>,
    /// At least one.
    pub components: Vec<Component>,
    /// Index of the component that a run takes: the one asked for, else the stronger horizontal
    /// one.
    pub taken: usize,
    /// Whether the component was asked for.
    asked: bool,
    /// The file is a table of more columns than the one that was chosen.
    chosen: bool,
    /// Columns of bare values that were read row by row.
    row_by_row: Option<usize>,
    /// Its times were in ms.
    milliseconds: bool,
    /// The time step that the header says, where its times have another (s).
    other_step: Option<f64>,
    /// Why a column of the vertical motion that cannot be read is none.
    pub(super) vertical_refused: Option<RecordError>,
    /// The vertical component asked for, and how many samples after the record's end it has.
    vertical: Option<(Record, usize)>,
    pub(super) file: String,
}

impl Recording {
    /// The components in a file of any supported format.
    ///
    /// # Errors
    /// The file cannot be read, is no record, is damaged, does not have the peak that its header
    /// gives, or does not agree with the options: see [`RecordError`].
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, RecordError> {
        let bytes = super::bytes(path)?;
        let without = ReadOptions { vertical: None, ..options.clone() };
        let mut recording = Self::parse(&super::label(path), &bytes, &without)?;
        let several = recording.components.len() > 1 || recording.chosen;
        for component in &mut recording.components {
            component.record.source = Source::File {
                path: path.into(),
                units: component.units,
                component: component.name.clone().filter(|_| several),
                baseline: options.baseline,
                vertical_left_out_g: None,
                vertical_taken: None,
            };
        }
        recording.vertical = recording.check_vertical(options)?;
        let left_out = recording.vertical_left_out();
        let taken = &mut recording.components[recording.taken];
        let only = (taken.direction == Direction::Vertical).then(|| taken.label());
        if let Source::File { vertical_left_out_g, vertical_taken, .. } = &mut taken.record.source {
            (*vertical_left_out_g, *vertical_taken) = (left_out, only);
        }
        Ok(recording)
    }

    /// The same from the bytes of a file; `file` is the file's path, for names and messages.
    ///
    /// # Errors
    /// As [`Recording::read`], but for reading the file.
    pub fn parse(file: &str, bytes: &[u8], options: &ReadOptions) -> Result<Self, RecordError> {
        let path = Path::new(file);
        let file = &super::label(path);
        if let Some(dt) = options.dt {
            super::check_step(file, dt)?;
        }
        let text = text::decode(file, bytes)?;
        if text.trim().is_empty() {
            return Err(RecordError::Empty { file: file.clone() });
        }
        let format = RecordFormat::of(&text);
        let is_at2 = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("at2"));
        if is_at2 && format == RecordFormat::Columns {
            return Err(RecordError::NoHeader { file: file.clone() });
        }
        if format == RecordFormat::Columns && is_case(&text) {
            return Err(RecordError::IsCase { file: file.clone() });
        }
        let parsed = format.parse(file, &text, options)?;

        let stem =
            path.file_stem().map_or_else(|| file.clone(), |stem| super::label(Path::new(stem)));
        let several = parsed.channels.len() > 1 || parsed.chosen;
        let component = |(i, channel): (usize, Channel)| {
            let name = match (&channel.name, several) {
                (Some(name), true) => format!("{stem} {name}"),
                (None, true) => format!("{stem} {}", i + 1),
                (_, false) => stem.clone(),
            };
            channel.into_component(file, &name, options)
        };
        let components = parsed
            .channels
            .into_iter()
            .enumerate()
            .map(component)
            .collect::<Result<Vec<_>, _>>()?;
        if components.is_empty() {
            return Err(RecordError::Empty { file: file.clone() });
        }
        let (station, asked) = (parsed.station, options.component.is_some());
        let mut recording = Self {
            format,
            station,
            components,
            taken: 0,
            asked,
            chosen: parsed.chosen,
            row_by_row: parsed.row_by_row,
            milliseconds: parsed.milliseconds,
            other_step: parsed.other_step,
            vertical_refused: parsed.vertical_refused,
            vertical: None,
            file: file.clone(),
        };
        recording.taken = match &options.component {
            Some(wanted) => recording.find(wanted)?,
            None => recording.strongest_horizontal(),
        };
        recording.vertical = recording.check_vertical(options)?;
        Ok(recording)
    }

    /// The component that a run takes.
    pub fn component(&self) -> &Component {
        &self.components[self.taken]
    }

    /// Whether it is a column of a table that was chosen.
    pub(super) fn is_chosen(&self) -> bool {
        self.chosen
    }

    /// The record that a run takes.
    pub fn into_record(mut self) -> Record {
        let record = self.components.swap_remove(self.taken).record;
        match self.vertical {
            // checked as it was read
            Some((Record { name, accel, source, .. }, _)) => {
                Record { vertical: Some(Vertical { name, accel: accel.into(), source }), ..record }
            }
            None => record,
        }
    }

    /// Peak of the file's vertical component, if a run does not take it: the strongest of several
    /// (g).
    pub(crate) fn vertical_left_out(&self) -> Option<f64> {
        if self.vertical.is_some() {
            return None;
        }
        let others = self.components.iter().enumerate().filter(|(i, _)| *i != self.taken);
        let vertical = others.filter(|(_, component)| component.direction == Direction::Vertical);
        vertical.map(|(_, component)| component.record.pga_g()).max_by(f64::total_cmp)
    }

    /// What the user should know of the record that a run takes.
    pub fn notices(&self) -> Vec<Notice> {
        let taken = self.component();
        let file = || self.file.clone();
        let mut notices = Vec::new();
        if let Some(columns) = self.row_by_row {
            notices.push(Notice::RowByRow { file: file(), columns, samples: taken.record.len() });
        }
        if self.milliseconds {
            notices.push(Notice::Milliseconds { file: file(), dt: taken.record.dt });
        }
        if let Some(said) = self.other_step {
            notices.push(Notice::OtherStep { file: file(), said, dt: taken.record.dt });
        }
        if !self.asked && self.components.len() > 1 {
            let others = self.components.iter().enumerate().filter(|(i, _)| *i != self.taken);
            let others: Vec<String> = others.map(|(_, component)| component.label()).collect();
            notices.push(Notice::Taken {
                file: file(),
                taken: taken.label(),
                pga_g: taken.record.pga_g(),
                others: others.join(", "),
            });
        }
        if !self.asked && taken.direction == Direction::Vertical {
            notices.push(Notice::OnlyVertical { file: file(), component: taken.label() });
        }
        if let Some((vertical, samples @ 1..)) = &self.vertical {
            let (vertical, samples) = (vertical.name.clone(), *samples);
            notices.push(Notice::VerticalCut { file: file(), vertical, samples });
        }
        notices.extend(taken.notices(&self.file));
        notices
    }

    /// The strongest of the components that are not vertical, else the strongest.
    fn strongest_horizontal(&self) -> usize {
        let rank = |component: &Component| {
            (component.direction != Direction::Vertical, component.record.pga())
        };
        let mut best = 0;
        for (i, component) in self.components.iter().enumerate() {
            if rank(component) > rank(&self.components[best]) {
                best = i;
            }
        }
        best
    }

    /// The component of a name or an azimuth.
    fn find(&self, wanted: &str) -> Result<usize, RecordError> {
        let by = |test: &dyn Fn(&Component) -> bool| -> Vec<usize> {
            (0..self.components.len()).filter(|&i| test(&self.components[i])).collect()
        };
        let wanted = wanted.trim();
        let named =
            by(&|c| c.name.as_deref().is_some_and(|name| name.eq_ignore_ascii_case(wanted)));
        let degrees = wanted.parse().map_or_else(|_| Direction::of(wanted), Direction::azimuth);
        let directed = by(&|c| c.direction.same(degrees));
        match (&named[..], &directed[..]) {
            ([only], _) | ([], [only]) => Ok(*only),
            _ => {
                let labels =
                    self.components.iter().map(Component::label).filter(|label| !label.is_empty());
                let labels: Vec<String> = labels.collect();
                let labels =
                    if labels.is_empty() { vec!["one without a name".to_owned()] } else { labels };
                Err(RecordError::NoComponent {
                    file: self.file.clone(),
                    wanted: quote(wanted),
                    several: named.len().max(directed.len()) > 1,
                    available: shorten(labels.join(", ")),
                })
            }
        }
    }
}

/// Whether a text is a case file: TOML with a section `[structure]`.
fn is_case(text: &str) -> bool {
    text.contains("[structure]")
        && text.parse::<toml::Table>().is_ok_and(|file| file.contains_key("structure"))
}

/// A list that keeps a message to one line that can be read.
fn shorten(list: String) -> String {
    if list.chars().count() <= 160 {
        list
    } else {
        list.chars().take(160).chain("...".chars()).collect()
    }
}

impl Component {
    /// Name and direction, for messages and tables; empty where the file gives neither.
    pub fn label(&self) -> String {
        match (&self.name, self.direction) {
            (Some(name), Direction::Unknown) => quote(name),
            (Some(name), direction) => format!("{} ({direction})", quote(name)),
            (None, Direction::Unknown) => String::new(),
            (None, direction) => direction.to_string(),
        }
    }

    /// What the user should know of this component.
    pub fn notices(&self, file: &str) -> Vec<Notice> {
        let mut notices = Vec::new();
        let (file, component) = (file.to_owned(), self.label());
        let pga = self.record.pga();
        let still = super::parsed::mean(&self.record.accel);
        // one sample is its own mean
        if self.record.len() > 1 && still.abs() > Notice::OFFSET_SHARE * pga {
            let share = still.abs() / pga;
            notices.push(Notice::Offset {
                file: file.clone(),
                component: component.clone(),
                share,
            });
        }
        notices.extend(super::notice::notices(&self.record, &file, &component));
        notices
    }
}
