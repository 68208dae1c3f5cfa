//! Energies at the switches of the net, Remark 5.

use super::energy::about;
use super::model::{Model, Others};
use crate::claim::{About, Bound, Claim, Finding, Judging, Reading, Run, Side};
use crate::world::spec::AlphaProtocol;

const SEQUENCE: About = about(
    "olfati-saber-2003/switching-energies-printed",
    "Olfati-Saber (2003), Remark 5",
    Reading::Misprinted,
    [
        "Under (34), the energies H_s at the switches of the net are a decreasing sequence. Every \
         new link adds h0 to H_s, (31), so this can fail; nonsmooth-dissipation has what holds.",
        "Protocol (34) between all agents, no other forces; the net switches.",
        "H_s in every observation, which would have to stay below that of the start.",
    ],
);

/// As printed.
pub(super) struct SwitchingEnergies;

impl<const D: usize> Claim<D> for SwitchingEnergies {
    fn about(&self) -> &'static About {
        &SEQUENCE
    }

    fn judge(&self, run: &Run<'_, D>) -> Option<Finding> {
        let model = Model::of(run)?;
        let mut judging = Judging::new(run);
        model.suppose_protocol(&mut judging, "(34)", &[AlphaProtocol::Nonsmooth]);
        model.suppose(&mut judging, Others::None);
        let start = model.net(run.start());
        let switches = run.observations.iter().any(|seen| model.net(seen) != start);
        judging.suppose("the net switches", switches);
        let energies = run.series(|seen| model.energy(seen, &model.pair));
        let slack = run.observations.iter().zip(&energies);
        let slack = slack.map(|(seen, energy)| model.energy_slack(seen, *energy));
        let (slack, first) = (slack.collect(), energies[0]);
        judging.bound(Bound {
            name: "H_s",
            times: run.times(),
            bounds: vec![first; energies.len()],
            values: energies,
            slack,
            side: Side::Below,
            scale: first,
        });
        Some(judging.finding())
    }
}
