//! What is said of a rigid body's run: Housner's body beside the finite elements on their springs.

pub mod at_once;
mod limits;
mod peaks;
pub mod program;
mod sections;
mod sink;
pub mod tables;
mod taken;
mod walk;

use super::{
    AccuracyReport, Assumed, FiledParameters, ProgramReport, Run, Section, Taken, Unit, changes,
    cut_at_largest, doubts, filed, judged,
    program::with_verdict,
    reference::{self, HousnerReport},
    stiffness_tradeoff::TradeoffPoint,
};
use cases::{Case, Objective, doubts::Doubt};
use decks::stepped_history;
use dynamics::spring::{Design, Springs};
use fixed_steps::FixedStepHistory;
use limits::springs_findings;
use parameters::{
    MembersAccuracy, PaperProcedure, Parameters,
    answers::{MemberHistory, ModelComparison, compare_models, with_members},
    rigid_forces::design_forces,
};
use peaks::{peaks, peaks_to};
use results::{Finding, PeakChange};
use rocking::{members::Members, structure::Kind};
use sections::sections;
use springs::{job::Job, paper_procedure::table_1};
use strong_motion::Record;
use taken::taken;

/// A job done: springs, both models' histories, and what parameters.json holds.
pub struct RigidRun {
    /// As it was given.
    pub case: Case,
    /// Its springs.
    pub job: Job,
    /// Error over the stiffness.
    pub front: Vec<TradeoffPoint>,
    /// Both models' answers to the record.
    pub both: ModelComparison,
    /// Conditioning and regime.
    pub report: HousnerReport,
    /// On the springs for a program with fixed time steps, as that would find it.
    pub of_steps: Option<FixedStepHistory>,
    /// What the steps of its deck tell of how far its motion can be foretold.
    of_deck: Option<Finding>,
    /// Up to when it can (s), if not to its end.
    until: Option<f64>,
    /// What `parameters.json` holds, but for the record: where that is to be found depends on the
    /// folder.
    pub parameters: Parameters,
}

impl RigidRun {
    /// Simulate a job's springs, and those of the paper beside them; `friction` of the ground, for
    /// the warning of sliding.
    pub fn new(case: Case, job: Job, front: Vec<TradeoffPoint>, friction: f64) -> Self {
        let beside = |springs: &Springs<Design<f64>>| {
            let other = Parameters::new(case.structure, springs);
            let none = Members::default();
            let matched =
                compare_models(&job.body, case.restitution, &other.chains(), &none, &job.record)
                    .matched;
            PaperProcedure { vertical: other.vertical, horizontal: other.horizontal, matched }
        };
        let paper = job.paper.as_ref().filter(|_| case.tuning.objective == Objective::Landing);
        let recovered = table_1::of(&case.structure).filter(|_| job.paper.is_some());
        let chains = Parameters::new(case.structure, &job.springs).chains();
        let own = || {
            let both =
                compare_models(&job.body, case.restitution, &chains, &case.members, &job.record);
            (both, Parameters::of(&case, &job))
        };
        let others = || {
            (paper.map(|paper| beside(&paper.tuned.best.springs)), recovered.map(|r| beside(&r)))
        };
        let report =
            || HousnerReport::new(&job.body, case.restitution, &job.record, &job.rocking, friction);
        let ((both, mut parameters), ((paper, recovered), report)) =
            parallel::join(own, || parallel::join(others, report));
        let report = report.with_members(&job.body, &job.record, &both).with_conditioning(
            &job.body,
            &chains,
            &job.record,
            &both,
        );
        parameters.matched = Some(both.matched);
        parameters.match_with_members = both.with.as_ref().map(|with| with.matched);
        (parameters.paper_procedure, parameters.table_1) = (paper, recovered);
        parameters.conditioning = Some(report.conditioning.into());
        parameters.conditioning_with_members = report.of_members;
        parameters.verdict = Some(both.verdict(&job.body, job.record.dt, &report.conditioning));
        let kind = case.structure.kind;
        parameters.peaks = Some(peaks(kind, &job.body, job.record.dt, &both));
        let of_steps = parameters.program.as_ref();
        let of_steps = of_steps.and_then(|_| stepped_history(&parameters, &job.record).ok());
        let softer = softer(&case, &job, &job.record, &both);
        let (of_deck, until) = (None, None);
        let mut run = Self { case, job, front, both, report, of_steps, of_deck, until, parameters };
        (run.of_deck, run.until) = run.foretold();
        let Self { case, job, both, report, until, of_steps, parameters, .. } = &mut run;
        let dt = job.record.dt;
        let on_record = of_steps
            .as_ref()
            .and_then(|history| program::on_record(parameters, history, (both, dt), *until));
        if let Some(row) = &mut parameters.program {
            row.on_record = on_record;
        }
        // where his pivot would have to hold the body down no comparison means anything
        let flight = report.regime.free_flight.map(|flight| flight.time);
        let compared = until.iter().copied().chain(flight).reduce(f64::min);
        let of_members = both.with.as_ref();
        parameters.accuracy_with_members =
            of_members.and_then(|with| MembersAccuracy::new(&job.body, dt, with, compared));
        let forces = design_forces(kind, &job.body, &job.record, both, softer.as_ref(), *until);
        // where springs answer, softer ones check forces
        let checked = parameters.assessment.as_ref().filter(|_| softer.is_none());
        let err = checked.and_then(|assessment| assessment.missed_peaks());
        parameters.design_forces = Some(forces.checked_on_springs(err));
        let asked = case.program.is_some();
        let findings = run.findings();
        let row = run.parameters.program.as_mut();
        run.parameters.findings = filed(with_verdict(findings, row, asked));
        run.foretell(kind);
        run
    }

    /// All that is said of it; `parameters` are those filed.
    pub fn said(&self, parameters: Parameters) -> Run {
        let mut sections = sections(&parameters);
        sections.extend(self.sections());
        let record = &self.job.record;
        let sap2000 = parameters.members().is_none();
        let alone = alone(parameters);
        let mut facts = alone.taken.facts.clone();
        // feet that slide hold the body down for longer than his
        let rocking = match &self.both.with {
            Some(with) => with.rocking.as_ref(),
            None => Some(&self.job.rocking),
        };
        let first = rocking.and_then(|rocking| rocking.uplifts.first());
        facts.extend(first.map(|uplift| super::first_lift(uplift.time)));
        Run {
            taken: Taken {
                facts,
                record: Some(self.case.excitation.line()),
                short_record: Some(self.case.excitation.short_line()),
                vertical: record.vertical.is_some(),
                assumed: self.assumed(),
                ..taken(&self.case.structure, self.case.restitution, &self.case.members)
            },
            friction_needed: Some(self.report.friction_needed()),
            friction_in_landings: self.report.needs_friction_to_land(),
            sap2000,
            sections,
            ..alone
        }
    }

    fn assumed(&self) -> Vec<Assumed> {
        let mut all = Assumed::all(&self.case.assumptions());
        if self.case.members.friction.is_none() {
            all.push(Assumed {
                what: "feet do not slide".into(),
                key: "friction.coefficient".into(),
            });
        }
        all
    }

    fn findings(&self) -> Vec<Finding> {
        let parameters = &self.parameters;
        // what of the search was cut, first
        let mut all = self.job.findings(self.case.tuning.asked());
        let judged = parameters
            .assessment
            .is_some_and(|a| a.reached && a.measured.synthetic_median.is_some());
        if let Some(verdict) = &parameters.verdict {
            let (structure, record) = (&self.case.structure, &self.job.record);
            all.extend(reference::verdict(structure, record, &self.both, (verdict, &self.report)));
            all.extend(reference::ill_conditioned(&self.report, verdict, judged));
        }
        let peaks = parameters.peaks.map(|pair| pair.with_members.unwrap_or(pair.reference));
        let whole = &self.case.excitation.record;
        all.extend(peaks.and_then(|peaks| cut_at_largest(&peaks, whole, &self.job.record)));
        all.extend(self.vertical_left_out());
        all.extend(doubts(self.case.doubts()));
        all.extend(springs_findings(parameters));
        all.extend(program::findings(&self.case, parameters));
        all.extend(parameters.design_forces.iter().flat_map(|forces| forces.withheld()));
        all.extend(parameters.design_forces.iter().filter_map(|forces| forces.at_rest()));
        all.extend(self.report.findings_beside(&self.both));
        all.extend(sink::finding(&self.job.body, self.both.matched.settlement_m));
        all.extend(walk::finding(&self.job.body, self.job.record.dt, &self.both));
        all.extend(reference::histories(&self.both));
        all.extend(self.of_deck.clone());
        all
    }

    /// Say of peaks and forces whether they can be foretold.
    fn foretell(&mut self, kind: Kind) {
        let Self { job, both, until, parameters, .. } = self;
        parameters.design_forces =
            parameters.design_forces.map(|forces| forces.foretold_to(*until));
        if let Some(until) = *until {
            let part = peaks_to(Some(until), kind, &job.body, job.record.dt, both);
            parameters.peaks = parameters.peaks.map(|peaks| peaks.foretold(until, &part));
        }
    }

    /// What the steps of its deck tell of how far its motion can be foretold; up to when that is
    /// (s), if not to its end.
    fn foretold(&self) -> (Option<Finding>, Option<f64>) {
        let Self { case, job, both, report, parameters, .. } = self;
        // with members the springs answer, which go on where his pivot lets go
        let own =
            |f: &Finding| both.with.is_none() || !matches!(f, Finding::PivotLeavesGround { .. });
        let of = |finding: &Finding| finding.predictable_to().filter(|_| own(finding));
        let verdict = parameters.verdict.as_ref();
        let conditioned = verdict.and_then(|v| reference::ill_conditioned(report, v, false));
        let until = report.findings().iter().chain(&conditioned).filter_map(of).reduce(f64::min);
        let well = report.well_conditioned();
        let judged = judged::rigid(&case.structure, parameters, &job.record, (well, until));
        let until = judged.iter().filter_map(of).chain(until).reduce(f64::min);
        (judged, until)
    }

    /// A vertical component of some size that is left out: what it would change.
    fn vertical_left_out(&self) -> Option<Finding> {
        let doubts = self.case.doubts();
        let (vertical_g, horizontal_g) = doubts.iter().find_map(Doubt::vertical_left_out)?;
        let excitation = self.case.excitation.with_vertical_left_out()?.ok()?;
        let record = excitation.used().ok()?;
        let Self { case, job, .. } = self;
        let chains = self.parameters.chains();
        let both = compare_models(&job.body, case.restitution, &chains, &case.members, &record);
        let kind = case.structure.kind;
        // where Housner's solution ends, forces are of springs
        let softer = softer(case, job, &record, &both);
        let (peaks, forces) = (
            peaks(kind, &job.body, record.dt, &both),
            design_forces(kind, &job.body, &record, &both, softer.as_ref(), None),
        );
        let given = (self.parameters.peaks, self.parameters.design_forces);
        let (body, friction) = (&job.body, f64::INFINITY);
        let report = HousnerReport::new(body, case.restitution, &record, &both.rocking, friction)
            .with_members(body, &record, &both)
            .with_conditioning(body, &chains, &record, &both);
        let verdict = both.verdict(body, record.dt, &report.conditioning);
        let doubts = reference::ill_conditioned(&report, &verdict, false);
        let predictable_to_s = report
            .findings()
            .iter()
            .chain(&doubts)
            .filter_map(|finding| finding.predictable_to())
            .reduce(f64::min);
        let words = super::force_words(kind);
        let mut changes = changes(words, given, (peaks, forces), predictable_to_s);
        // feet that slide need what there is
        let at = report.regime.friction_needed.time;
        let told = predictable_to_s.is_none_or(|until| at <= until);
        changes.extend((told && case.members.friction.is_none()).then(|| PeakChange {
            quantity: "friction needed".into(),
            unit: String::new(),
            without: self.report.friction_needed(),
            with: report.friction_needed(),
        }));
        // springs answer for members, and where Housner's solution ends before the record
        let overturns_s = match &both.with {
            Some(with) => with.matched.overturned_fem_s,
            None if both.rocking.left_ground().is_some() => both.matched.overturned_fem_s,
            None => both.matched.overturned_housner_s,
        };
        let checked = true;
        Some(Finding::VerticalLeftOut {
            vertical_g,
            horizontal_g,
            overturns_s,
            changes,
            predictable_to_s,
            checked,
        })
    }

    fn sections(&self) -> Vec<Section> {
        let mut all = Vec::new();
        let mut columns = vec![("", &self.both.demands)];
        columns.extend(self.both.with.as_ref().map(|with| ("with members, ", &with.demands)));
        let kind = self.case.structure.kind;
        let of_legs = match kind {
            Kind::AFrame => " Axial force is positive in tension; moments are those at the mass.",
            Kind::Block => "",
        };
        all.push(Section {
            id: "elements",
            title: "Forces of the finite elements".into(),
            text: vec![format!(
                "Between landings: later than 0.1/p after the last touch-down. In landings they \
                    are forces of the springs and grow with Omega_n: not to design with.{of_legs}"
            )],
            table: Some(tables::finite_element_forces(kind, &columns)),
            ..Section::default()
        });
        if !self.front.is_empty() {
            all.push(Section {
                id: "stiffness",
                title: "Error over the stiffness".into(),
                text: vec![
                    "Error of u against Omega_n, and what stiffness costs. Foot forces are those \
                        of the springs."
                        .into(),
                ],
                table: Some(tables::stiffness(&self.front)),
                ..Section::default()
            });
        }
        all
    }
}

/// Springs of a case without a record.
pub fn of_case(case: &Case, mut parameters: Parameters) -> Run {
    // what of the search was cut is there already
    let search = parameters.findings.iter().map(|filed| filed.finding.clone());
    let found =
        search.chain(doubts(case.doubts_of_structure())).chain(springs_findings(&parameters));
    let found = found.chain(program::findings(case, &parameters)).collect();
    let (row, asked) = (parameters.program.as_mut(), case.program.is_some());
    parameters.findings = filed(with_verdict(found, row, asked));
    alone(parameters)
}

/// Springs without a record.
fn alone(parameters: Parameters) -> Run {
    let units = [("vertical", parameters.vertical), ("horizontal", parameters.horizontal)]
        .map(|(name, row)| Unit::new(name, &row.chain()));
    let findings = match parameters.findings.is_empty() {
        true => filed(springs_findings(&parameters)),
        false => parameters.findings.clone(),
    };
    let accuracy = AccuracyReport::of_rigid(&parameters);
    Run {
        taken: taken(&parameters.structure, parameters.restitution(), &parameters.members()),
        reference: super::HOUSNER,
        peaks: parameters.peaks,
        friction_needed: None,
        friction_in_landings: false,
        design_forces: parameters.design_forces,
        springs_at: "each foot",
        springs: units.into(),
        program: ProgramReport::of_rigid(&parameters),
        accuracy,
        findings,
        sap2000: false,
        sections: sections(&parameters),
        parameters: FiledParameters::Rigid(Box::new(parameters)),
    }
}

/// The history on springs of a quarter of Omega_n, where Housner's cannot tell whether forces are
/// the springs': with members, and beyond where his pivot leaves the ground.
fn softer(
    case: &Case,
    job: &Job,
    record: &Record,
    both: &ModelComparison,
) -> Option<MemberHistory> {
    if both.with.is_none() && both.rocking.left_ground().is_none() {
        return None;
    }
    let quarter = |design: &Design<f64>| Design { omega_n_hz: design.omega_n_hz / 4.0, ..*design };
    let springs = Springs {
        vertical: quarter(&job.springs.vertical),
        horizontal: quarter(&job.springs.horizontal),
    };
    let (chains, e) = (springs.chains(case.structure.mass_kg), case.restitution);
    Some(with_members(&job.body, e, &chains, &case.members, record, (&both.rocking, &both.housner)))
}
