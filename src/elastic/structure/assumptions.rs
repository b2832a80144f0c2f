//! What a structure is taken to have because its case file does not say, and the key that says it.

use serde::{Deserialize, Serialize};

use super::{ElasticStructure, PierSpec, PortalSpec, SHEAR_FACTOR, pier::CONCRETE};
use crate::elastic::structure::POISSON;

/// A quantity that was not given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum Assumption {
    /// EA of a solid square concrete column of the same EI.
    AxialStiffness {
        /// EA (N).
        ea_n: f64,
        /// E [N/m2].
        youngs_modulus_n_per_m2: f64,
        /// Side of the square (m).
        side_m: f64,
    },
    /// GA_s of a column with a mass of its own: that of a solid rectangular concrete section of this EA.
    ShearStiffness {
        /// GA_s (N).
        ga_n: f64,
        /// nu.
        poissons_ratio: f64,
        /// Share of the area that shear acts on.
        shear_factor: f64,
    },
    /// Columns do not give in shear: they have no mass of their own.
    RigidInShear,
    /// Damping along the column is as across.
    AxialDamping {
        /// Ratio to critical damping.
        ratio: f64,
    },
    /// Elements to a column.
    Elements {
        /// How many.
        count: usize,
    },
    /// The footing is a solid block.
    FootingInertia {
        /// About its centre of mass [kg m2].
        inertia_kgm2: f64,
    },
    /// Of the mass at the apex.
    ApexInertia {
        /// About its centre [kg m2].
        inertia_kgm2: f64,
    },
}

/// An assumption and the key under `[structure]` that replaces it; none where there is no key.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Assumed {
    /// Key in the case file.
    pub key: Option<&'static str>,
    /// What was assumed.
    #[serde(flatten)]
    pub assumption: Assumption,
}

fn assumed(key: &'static str, assumption: Assumption) -> Assumed {
    Assumed { key: Some(key), assumption }
}

impl ElasticStructure {
    /// All that was assumed of it, what matters most for its forces first.
    pub fn assumptions(&self) -> Vec<Assumed> {
        match self {
            Self::Pier(pier) => pier.assumptions(),
            Self::AFrame(frame) => {
                let apex = Assumption::ApexInertia { inertia_kgm2: frame.inertia() };
                frame
                    .rotational_inertia_kgm2
                    .is_none()
                    .then(|| assumed("rotational_inertia_kgm2", apex))
                    .into_iter()
                    .collect()
            }
            Self::Frame(frame) => frame.assumptions(),
        }
    }
}

/// What is assumed of shear under this key.
fn shear(key: &'static str, column_mass: f64, ga: f64) -> Assumed {
    let concrete = Assumption::ShearStiffness { ga_n: ga, poissons_ratio: POISSON, shear_factor: SHEAR_FACTOR };
    assumed(key, if column_mass > 0.0 { concrete } else { Assumption::RigidInShear })
}

impl PierSpec {
    fn assumptions(&self) -> Vec<Assumed> {
        let mut all = Vec::new();
        if self.ea_n.is_none() {
            let side_m = (12.0 * self.ei() / CONCRETE).powf(0.25);
            let axial = Assumption::AxialStiffness { ea_n: self.ea(), youngs_modulus_n_per_m2: CONCRETE, side_m };
            all.push(assumed("ea_n", axial));
        }
        if self.ga_n.is_none() {
            all.push(shear("ga_n", self.column_mass_kg, self.ga()));
        }
        if self.axial_damping_ratio.is_none() {
            all.push(assumed("axial_damping_ratio", Assumption::AxialDamping { ratio: self.damping_ratio }));
        }
        if self.elements.is_none() && self.column_mass_kg > 0.0 {
            all.push(assumed("elements", Assumption::Elements { count: self.elements() }));
        }
        if self.footing_inertia_kgm2.is_none() {
            let inertia_kgm2 = self.footing_inertia();
            all.push(assumed("footing_inertia_kgm2", Assumption::FootingInertia { inertia_kgm2 }));
        }
        all
    }
}

impl PortalSpec {
    fn assumptions(&self) -> Vec<Assumed> {
        let mut all = Vec::new();
        if self.column_ga_n.is_none() {
            all.push(shear("column_ga_n", self.column_mass_kg, self.column_ga()));
        }
        if self.elements.is_none() && self.column_mass_kg > 0.0 {
            all.push(assumed("elements", Assumption::Elements { count: self.elements() }));
        }
        all.push(Assumed {
            key: None,
            assumption: Assumption::FootingInertia { inertia_kgm2: self.footing_inertia() },
        });
        all
    }
}
