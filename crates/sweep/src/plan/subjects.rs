//! The structures of a sweep: those given one by one, and those of a grid.

use std::collections::HashMap;

use toml::Spanned;

use crate::{
    SweepError,
    named::NamedStructure,
    spec::{Grid, Kinds, SweepSource},
};
use cases::doubts::Doubt;
use files::message::rounded;
use rocking::{
    members::Members,
    scalar::GRAVITY,
    structure::{self, Body, Structure},
};

/// One structure of a sweep.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its name.
    pub name: String,
    /// As given.
    pub structure: Structure,
    /// As the models have it.
    pub body: Body<f64>,
    /// A tendon and dampers.
    pub members: Members,
    /// Its own velocity restitution.
    pub restitution: f64,
    /// (rad)
    pub alpha: f64,
    /// (1/s)
    pub p: f64,
    /// What to look at again of what the file gives.
    pub doubts: Vec<Doubt>,
}

impl Subject {
    fn new(structure: Structure, restitution: f64) -> Self {
        let body = structure.body::<f64>();
        let kind = match structure.kind {
            structure::Kind::AFrame => "A-frame",
            structure::Kind::Block => "block",
        };
        let name =
            format!("{kind} R {} m, alpha {}", rounded(body.radius(), 4), rounded(body.alpha(), 4));
        let (alpha, p) = (body.alpha(), body.p());
        let members = Members::default();
        Self { name, structure, body, members, restitution, alpha, p, doubts: Vec::new() }
    }

    /// The same with a tendon and dampers, which its name tells.
    fn with_members(mut self, members: Members) -> Self {
        for (there, what) in
            [(members.tendon.is_some(), ", tendon"), (members.damper.is_some(), ", dampers")]
        {
            self.name += if there { what } else { "" };
        }
        Self { members, ..self }
    }

    /// Ground acceleration that lifts it at rest, with its tendon (m/s2).
    pub(crate) fn lifts_at(&self) -> f64 {
        let pull = self.members.tendon.map_or(0.0, |tendon| tendon.pretension);
        self.uplift() * (1.0 + pull / (self.body.mass * GRAVITY))
    }

    /// g tan(alpha): what lifts it at rest, without a tendon (m/s2).
    pub(crate) fn uplift(&self) -> f64 {
        GRAVITY * self.alpha.tan()
    }
}

/// What to do with a tendon and dampers where histories are not by Housner's equation alone.
const MEMBERS: &str = "a tendon and dampers are followed by Housner's equation alone, in kinds \
                       fragility and rocking; write model = \"housner\", or leave them out";

/// All structures that the file asks for; `by_housner`: whether their histories are by Housner's
/// equation alone.
pub(super) fn subjects(source: &SweepSource, by_housner: bool) -> Result<Vec<Subject>, SweepError> {
    let mut subjects = Vec::new();
    for named in &source.spec.structure {
        let NamedStructure { name, members, section } = named.get_ref();
        let (structure, e) = section
            .checked(&source.path)
            .map_err(|e| source.at(named, reason(&source.path, &e.to_string())))?;
        let members =
            members.checked(&structure.body()).map_err(|e| source.at(named, e.to_string()))?;
        if members.act() && !by_housner {
            return Err(source.at(named, MEMBERS));
        }
        let mut subject = Subject::new(structure, e).with_members(members);
        subject.doubts = section.doubts(&structure);
        if let Some(name) = name {
            subject.name = checked_name(source, name)?;
        }
        subjects.push(subject);
    }
    if let Some(grid) = &source.spec.grid {
        of_grid(source, grid, &mut subjects)?;
    }
    if subjects.is_empty() {
        return Err(source.at(
            &source.spec.sweep.kind,
            "no structure; give [[structure]] as in a case file, or [grid]",
        ));
    }
    if source.spec.sweep.restitution.is_none() {
        name_restitutions(&mut subjects);
    }
    number_namesakes(&mut subjects);
    Ok(subjects)
}

/// Letters of a structure's name at most: a figure's legend holds it.
const LONGEST_NAME: usize = 40;

/// A name that tables and figures can hold in one line.
fn checked_name(source: &SweepSource, name: &Spanned<String>) -> Result<String, SweepError> {
    let text = name.get_ref().trim();
    if text.is_empty()
        || text.chars().count() > LONGEST_NAME
        || text.contains(|c: char| c.is_control() || c == '|')
    {
        return Err(source
            .at(name, format!("name: give 1 to {LONGEST_NAME} letters in one line, without |")));
    }
    Ok(text.into())
}

/// The structures' restitutions in their names, where not all are equation 2's.
fn name_restitutions(subjects: &mut [Subject]) {
    let of_equation_2 = |subject: &Subject| subject.restitution == subject.body.restitution();
    if subjects.iter().all(of_equation_2) {
        return;
    }
    for subject in subjects {
        subject.name += &format!(", e = {}", rounded(subject.restitution, 4));
        if of_equation_2(subject) {
            subject.name += " (equation 2)";
        }
    }
}

/// Structures of one name get a number.
fn number_namesakes(subjects: &mut [Subject]) {
    let mut seen: HashMap<String, usize> = HashMap::new();
    for subject in subjects {
        let count = seen.entry(subject.name.clone()).or_default();
        *count += 1;
        if *count > 1 {
            subject.name += &format!(", number {count}");
        }
    }
}

/// The message of an error without the file's name, which stands before it anyway.
fn reason(path: &str, message: &str) -> String {
    message.strip_prefix(&format!("{path}: ")).unwrap_or(message).to_string()
}

fn of_grid(
    source: &SweepSource,
    grid: &Spanned<Grid>,
    subjects: &mut Vec<Subject>,
) -> Result<(), SweepError> {
    let Grid { kind, size_m, slenderness } = grid.get_ref();
    let kinds = match kind {
        Kinds::One(kind) => std::slice::from_ref(kind),
        Kinds::Some(kinds) => kinds,
    };
    let sizes = source.all_within("size_m", size_m, 1e-3, 1e4)?;
    let alphas = source.all_within("slenderness", slenderness, 0.005, 0.9)?;
    for &kind in kinds {
        for &alpha in &alphas {
            for &radius in &sizes {
                let mass_kg = 1000.0;
                let m_r2 = mass_kg * radius * radius;
                let structure = Structure {
                    kind,
                    height_m: radius * alpha.cos(),
                    width_m: 2.0 * radius * alpha.sin(),
                    mass_kg,
                    rotational_inertia_kgm2: match kind {
                        structure::Kind::AFrame => structure::LEAST_INERTIA * m_r2,
                        structure::Kind::Block => m_r2 / 3.0,
                    },
                };
                let structure =
                    structure.checked().map_err(|e| source.at(slenderness, e.to_string()))?;
                subjects.push(Subject::new(structure, structure.body::<f64>().restitution()));
            }
        }
    }
    Ok(())
}
