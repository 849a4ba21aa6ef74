//! What is tried, in which order, until a sound surface is found: [`LADDER`].

use super::control::Control;
use super::iterate_options::IterateOptions;
use super::procedure::Procedure;
use super::system::System;

/// One attempt at a surface.
#[derive(Debug)]
pub(crate) struct Rung {
    /// What it is called.
    pub name: &'static str,
    /// When it is tried.
    pub condition: Condition,
    /// The inner fairness that it begins with.
    pub weights: Weights,
    /// Where it begins.
    pub start: Start,
    /// How it goes on from there.
    pub procedure: Procedure,
    /// How it iterates.
    pub options: IterateOptions,
    /// What becomes of a surface that meets the tolerance. A sound one of an attempt at the solution ends the search.
    pub kept: Kept,
}

impl Rung {
    /// Whether each of its iterations is one at what is asked.
    pub(crate) fn solves_what_is_asked(&self) -> bool {
        let is_plain = matches!(
            self.procedure,
            Procedure::Iteration | Procedure::WeightRepair | Procedure::RepairHere
        );
        is_plain && self.kept != Kept::Start
    }
}

/// When an attempt is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Condition {
    /// Wherever there is its start.
    Always,
    /// With a right-hand side that is not zero.
    Target,
    /// With a harmonic surface asked; also where a sound one is found whose total curvature leaves room for another.
    Harmonic,
}

impl Condition {
    /// Whether it is met.
    pub(crate) fn holds(self, system: &System, control: &Control<'_>) -> bool {
        match self {
            Self::Always => true,
            Self::Target => system.asks_for_target(),
            Self::Harmonic => !system.asks_for_target() && !control.exhausted(),
        }
    }
}

/// Inner fairness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Weights {
    /// As asked.
    Asked,
    /// Mean-value weights of the surface of least bending, which is so its solution already (nearly: its rings are not plane).
    LeastBending,
    /// Of the input's triangles, where uniform ones are asked.
    Input,
    /// As the attempts before have left it, repaired.
    AsLeft,
    /// None: vertices move along the normals alone. On a surface that is nearly closed, inner fairness (7.3) has no solution, or one that
    /// the vertices slide away from: an elastic net drawn over a ball slips off to one side. To (4) it is all one where the vertices lie,
    /// as long as the triangles are sound.
    None,
}

/// Where an attempt begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Start {
    /// The surface of a problem close to this one, in a solver.
    AtHand,
    /// The linear surface (7.4) with the inner fairness that is asked for.
    Linear,
    /// The same with the attempt's own.
    OwnLinear,
    /// The surface that descent from the linear one leads to.
    LeastBending,
    /// The surface found on the coarse mesh,
    Coarse,
    /// where that is another member of the family.
    CoarseMember,
    /// The surface of minimal energy.
    MinimalEnergy,
    /// The surface of smallest step norm at which an attempt at the solution has stalled.
    Stalled,
    /// Where a second surface may be, beside the sound one that is found.
    BesideSound,
}

/// What is kept of an attempt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kept {
    /// A surface that meets the tolerance but is not sound is a result, if there is none better.
    Result,
    /// Only a sound surface.
    Sound,
    /// It is where other attempts begin.
    Start,
}

/// Quasi-Newton steps to the tolerance.
pub(super) const DIRECT: IterateOptions = IterateOptions {
    tolerance_floor: 0.0,
    patience: 5,
    rounds: 5,
    stop_on_folds: false,
    reuse_factor: false,
    follows: false,
    phase: "fairing",
};

/// Near a place where two surfaces meet, the equation hardly answers to what they differ by: it takes a few steps to learn how.
const PATIENT: IterateOptions = IterateOptions {
    patience: 12,
    phase: super::soft_mode::PHASE,
    ..DIRECT
};

/// Step norm of surfaces that others begin with.
/// Of 42 cases, half: 1 changes by up to 9e-9 edges, +1 % iterations; double: 1 changes by up to 2e-13 edges, -2 % iterations.
pub(crate) const COARSE: f64 = 1e-4;

/// The attempts, in their order.
pub(crate) const LADDER: &[Rung] = &[
    Rung {
        name: "goes on",
        condition: Condition::Always,
        weights: Weights::AsLeft,
        start: Start::AtHand,
        procedure: Procedure::Iteration,
        options: IterateOptions {
            reuse_factor: true,
            ..DIRECT
        },
        kept: Kept::Sound,
    },
    Rung {
        name: "from the coarse mesh",
        condition: Condition::Always,
        weights: Weights::Asked,
        start: Start::Coarse,
        procedure: Procedure::RepairHere,
        options: DIRECT,
        kept: Kept::Result,
    },
    Rung {
        name: "member of the coarse mesh",
        condition: Condition::Harmonic,
        weights: Weights::Asked,
        start: Start::CoarseMember,
        procedure: Procedure::Retreat,
        options: DIRECT,
        kept: Kept::Result,
    },
    Rung {
        name: "direct",
        condition: Condition::Always,
        weights: Weights::Asked,
        start: Start::Linear,
        procedure: Procedure::WeightRepair,
        options: DIRECT,
        kept: Kept::Result,
    },
    Rung {
        name: "target continuation",
        condition: Condition::Target,
        weights: Weights::Asked,
        start: Start::Linear,
        procedure: Procedure::TargetContinuation,
        options: IterateOptions {
            tolerance_floor: COARSE,
            phase: "target continuation",
            ..DIRECT
        },
        kept: Kept::Result,
    },
    Rung {
        name: "along normals",
        condition: Condition::Always,
        weights: Weights::None,
        start: Start::Stalled,
        procedure: Procedure::Iteration,
        options: IterateOptions {
            phase: "along the normals",
            ..DIRECT
        },
        kept: Kept::Result,
    },
    Rung {
        name: "from least bending",
        condition: Condition::Always,
        weights: Weights::LeastBending,
        start: Start::LeastBending,
        procedure: Procedure::Regain,
        options: DIRECT,
        kept: Kept::Result,
    },
    // Uniform weights fold triangles where the connectivity is that of other places, as beside a crease.
    Rung {
        name: "spread as the input",
        condition: Condition::Always,
        weights: Weights::Input,
        start: Start::OwnLinear,
        procedure: Procedure::WeightRepair,
        options: DIRECT,
        kept: Kept::Sound,
    },
    Rung {
        name: "second surface",
        condition: Condition::Harmonic,
        weights: Weights::Asked,
        start: Start::BesideSound,
        procedure: Procedure::Regain,
        options: PATIENT,
        kept: Kept::Result,
    },
    Rung {
        name: "minimal energy",
        condition: Condition::Harmonic,
        weights: Weights::LeastBending,
        start: Start::LeastBending,
        procedure: Procedure::MinimalEnergy,
        options: IterateOptions {
            tolerance_floor: COARSE,
            // Along a valley the energy falls while the step norm stays.
            patience: 16,
            phase: "minimal energy",
            ..DIRECT
        },
        kept: Kept::Start,
    },
    Rung {
        name: "nearest member",
        condition: Condition::Harmonic,
        weights: Weights::LeastBending,
        start: Start::MinimalEnergy,
        procedure: Procedure::Approach,
        options: IterateOptions {
            phase: "nearest member",
            ..DIRECT
        },
        kept: Kept::Result,
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    fn condition(condition: Condition) -> &'static str {
        match condition {
            Condition::Always => "",
            Condition::Target => "right-hand side not zero",
            Condition::Harmonic => "harmonic surface asked, iterations left",
        }
    }

    fn start(start: Start) -> &'static str {
        match start {
            Start::AtHand => "surface at hand",
            Start::Linear => "linear",
            Start::OwnLinear => "linear with these weights",
            Start::LeastBending => "least bending",
            Start::Coarse => "of the coarse mesh",
            Start::CoarseMember => "member of the coarse mesh",
            Start::MinimalEnergy => "minimal energy",
            Start::Stalled => "best that stalled",
            Start::BesideSound => "along the softest mode",
        }
    }

    fn procedure(procedure: Procedure) -> &'static str {
        match procedure {
            Procedure::Iteration => "iteration",
            Procedure::WeightRepair => "iteration, weight repair",
            Procedure::RepairHere => "iteration, weight repair from there",
            Procedure::Regain => "iteration, weight repair from there, then with the weights asked",
            Procedure::MinimalEnergy => "iteration, weight repair, minimal energy",
            Procedure::Approach => "members of the family, towards harmonic",
            Procedure::Retreat => "members of the family, from that of the coarse mesh",
            Procedure::TargetContinuation => "parts of the right-hand side",
        }
    }

    /// A line of the table in ARCHITECTURE.md.
    fn line(attempt: &Rung) -> String {
        let weights = match attempt.weights {
            Weights::Asked => "asked",
            Weights::LeastBending => "of least bending",
            Weights::Input => "of the input",
            Weights::AsLeft => "as left",
            Weights::None => "none",
        };
        let IterateOptions {
            tolerance_floor,
            reuse_factor,
            ..
        } = attempt.options;
        let tolerance = if tolerance_floor > 0.0 {
            format!("{tolerance_floor:e}")
        } else {
            "asked".to_owned()
        };
        let matrix = if reuse_factor { "kept" } else { "measured" };
        let kept = match attempt.kept {
            Kept::Result => "result",
            Kept::Sound => "if sound",
            Kept::Start => "as start",
        };
        let name = attempt.name;
        let condition = condition(attempt.condition);
        let (start, procedure) = (start(attempt.start), procedure(attempt.procedure));
        format!(
            "| {name} | {condition} | {weights} | {start} | {procedure} | {tolerance} | {matrix} | {kept} |"
        )
    }

    #[test]
    fn the_documents_quote_the_ladder() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/ARCHITECTURE.md");
        let text = std::fs::read_to_string(path).unwrap();
        let wanted: Vec<String> = LADDER.iter().map(line).collect();
        let quoted: Vec<&str> = text
            .lines()
            .skip_while(|l| !l.starts_with("| attempt |"))
            .skip(2)
            .take_while(|l| l.starts_with('|'))
            .collect();
        assert_eq!(quoted, wanted, "\n{}", wanted.join("\n"));
    }
}
