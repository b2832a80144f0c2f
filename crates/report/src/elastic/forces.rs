//! Design forces of an elastic structure, as parameters.json has them.

use ::results::{DesignForce, DesignForces};
use frames::{
    design_forces::{ForceName, ForcesTogether, StructureForces},
    structure::ElasticStructure,
};

/// Share of the largest moment at the base below which that at the top is not said: a mass on a
/// hinge.
const LEAST_TOP_MOMENT: f64 = 0.01;

/// Share of the largest axial force below which a tension is not said.
const LEAST_TENSION: f64 = 0.01;

/// A run's forces, as parameters.json has them.
pub fn design_forces(structure: &ElasticStructure, of: &StructureForces) -> DesignForces {
    // a leg has no mass and a hinge at its foot
    let leg = match structure {
        ElasticStructure::AFrame(frame) => Some(frame.leg_length()),
        ElasticStructure::Pier(_) | ElasticStructure::Frame(_) => None,
    };
    let force = |kind: ForceName| {
        let force = of.get(kind)?;
        Some(DesignForce {
            value: force.value,
            time_s: force.time_s,
            holds: force.holds,
            change: Some(force.others.change()).filter(|change| change.is_finite()),
            raw: Some(force.raw),
            fixed: force.fixed.map(|peak| peak.value).filter(|value| *value != 0.0),
            rigid: force.rigid.map(|peak| peak.value),
            at_rest: None,
            corner: None,
            springs_err: None,
            together: force.together.map(|with| ForcesTogether {
                apex_moment_nm: leg.map(|leg| with.column_shear_n * leg),
                ..with
            }),
            above_base_m: force.above_base_m,
            over_s: force.whole_record.map(|_| force.over_s),
            whole_record: force.whole_record,
            held: force.held,
            predictable: None,
            others: Some(force.others),
        })
    };
    let column_shear_n = force(ForceName::ColumnShear);
    let axial_n = force(ForceName::Axial);
    let found = |force: DesignForce| force.others.map_or(0.0, |others| others.found.abs());
    let most = axial_n.map_or(0.0, found);
    let axial_tension_n =
        force(ForceName::AxialTension).filter(|tension| found(*tension) > LEAST_TENSION * most);
    let base_moment = force(ForceName::ColumnBaseMoment).map_or(0.0, found);
    let column_top_moment_nm = force(ForceName::ColumnTopMoment)
        .filter(|top| found(*top) > LEAST_TOP_MOMENT * base_moment);
    let apex_moment_nm = column_shear_n.zip(leg).map(|(shear, leg)| shear.times(leg));
    DesignForces {
        below_hz: of.cutoff.as_ref().map(|cutoff| cutoff.cutoff_hz),
        column_shear_n,
        column_base_moment_nm: force(ForceName::ColumnBaseMoment),
        column_top_moment_nm,
        axial_n,
        axial_tension_n,
        apex_moment_nm,
        sole_shear_n: force(ForceName::SoleShear),
        sole_vertical_n: force(ForceName::SoleVertical),
        tendon_n: force(ForceName::Tendon),
        damper_n: force(ForceName::Damper),
        ..DesignForces::default()
    }
}
