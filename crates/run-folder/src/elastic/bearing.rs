//! What the structure bears: on its springs, held to the ground, as a rigid body.

use frames::{
    answer::ElasticAnswer,
    assembled::Assembled,
    beam::BeamForces,
    design_forces::ForceName,
    fem::{ElasticHistory, resolves},
    structure::ElasticStructure,
};
use rocking::motion::peak;

/// Frequency above which forces of the ground are taken to be the springs' (Hz).
const FILTER_HZ: f64 = 20.0;

/// Name of the drift among the quantities.
pub(crate) const DRIFT: &str = "drift";

/// A quantity and how it is had from each model, as largest magnitudes since the sample before.
pub(crate) struct ForceQuantity {
    pub name: &'static str,
    pub unit: &'static str,
    /// Rocking on springs, fixed to the ground, rigid: empty where a model has none.
    pub series: [Vec<f64>; 3],
}

/// What a run's tables and figures of forces are made from.
pub(crate) struct ForceQuantities {
    pub quantities: Vec<ForceQuantity>,
    /// Vertical force of the ground on all corners together, without the spikes of landings (N).
    pub filtered: Vec<f64>,
    /// Frequency up to which the latter is had (Hz); none where samples are too far apart, it is
    /// then the mean between them.
    pub below_hz: Option<f64>,
}

impl ForceQuantities {
    pub(crate) fn new(assembled: &Assembled, answer: &ElasticAnswer, dt: f64) -> Self {
        let fem = &answer.histories.fem;
        let fine = fem.fine.as_ref().filter(|fine| resolves(fine.part_s, FILTER_HZ));
        let (filtered, below) = match fine {
            Some(fine) => (fine.sole_vertical_below(FILTER_HZ, dt, fem.demands.len()), true),
            None => (fem.ground.filtered(1, dt, FILTER_HZ), resolves(dt, FILTER_HZ)),
        };
        let below_hz = below.then_some(FILTER_HZ);
        Self { quantities: quantities(assembled, answer), filtered, below_hz }
    }
}

/// Index of beams that end on a footing, and which end it is, from the left.
fn bases(assembled: &Assembled) -> Vec<(usize, usize)> {
    let footing = |node: usize| assembled.frame.footing_nodes().contains(&node);
    let members = assembled.layout.members.iter().enumerate();
    members
        .filter_map(|(i, member)| Some((i, member.ends.iter().position(|end| footing(end.node))?)))
        .collect()
}

/// Shear, axial force and moments of the column or leg in which each is largest, unfiltered, and
/// the drift.
fn quantities(assembled: &Assembled, answer: &ElasticAnswer) -> Vec<ForceQuantity> {
    let bases = bases(assembled);
    let largest = |history: &ElasticHistory, of: &dyn Fn(&BeamForces, usize) -> f64| -> Vec<f64> {
        let column = |&(i, end): &(usize, usize)| -> Vec<f64> {
            history.worst.iter().map(|demand| of(&demand.bearings[i], end)).collect()
        };
        let columns = bases.iter().map(column);
        columns
            .reduce(|a, b| if peak(&b).abs() > peak(&a).abs() { b } else { a })
            .unwrap_or_default()
    };
    let both = |of: &dyn Fn(&BeamForces, usize) -> f64| {
        [&answer.histories.fem, &answer.fixed].map(|h| largest(h, of))
    };
    let rigid = answer.rigid.as_ref();
    let [shear, fixed] = both(&|beam, _| beam.shear);
    let body = rigid.map_or(Vec::new(), |rigid| rigid.shear.clone());
    let mut all = vec![ForceQuantity {
        name: ForceName::ColumnShear.words(),
        unit: "N",
        series: [shear, fixed, body],
    }];
    let [axial, fixed] = both(&|beam, _| beam.axial);
    let body = rigid.map_or(Vec::new(), |rigid| rigid.axial.clone());
    all.push(ForceQuantity {
        name: ForceName::Axial.words(),
        unit: "N",
        series: [axial, fixed, body],
    });
    // a leg is hinged at its foot
    if !matches!(assembled.structure, ElasticStructure::AFrame(_)) {
        let [moment, fixed] = both(&|beam, end| beam.moments[end]);
        let body = rigid.map_or(Vec::new(), |rigid| rigid.moment.iter().map(|x| -x).collect());
        all.push(ForceQuantity {
            name: "moment at base",
            unit: "N m",
            series: [moment, fixed, body],
        });
    }
    // a column of several elements has its top elsewhere
    if matches!(&assembled.structure, ElasticStructure::Frame(frame) if frame.elements() == 1) {
        let [moment, fixed] = both(&|beam, end| beam.moments[1 - end]);
        all.push(ForceQuantity {
            name: "moment at top",
            unit: "N m",
            series: [moment, fixed, Vec::new()],
        });
    }
    let drift = answer.histories.sways.first().map_or(Vec::new(), |pair| pair[1].drift.clone());
    all.push(ForceQuantity {
        name: DRIFT,
        unit: "m",
        series: [drift, answer.fixed_drift.clone(), Vec::new()],
    });
    all
}
