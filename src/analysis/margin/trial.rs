//! [`Trial`]: one group of a frame with something about it changed, judged as any other.

use crate::analysis::Verdict;
use crate::analysis::group::{heaviest, judged};
use crate::effect::Plan;
use crate::geometry::quarter_turn;
use crate::interface::Interface;
use crate::program::{Group, Program, Scale, assemble};
use crate::proof::Motion;
use crate::scene::{Frame, Load, RobotId, Scene};

/// What is changed about a group; by default nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setting {
    /// One friction coefficient for every interface.
    pub friction: Option<f64>,
    /// The safety kernel.
    pub kernel: Option<f64>,
    /// Share of each weight that acts along gravity.
    pub along: f64,
    /// Share of each weight that acts across gravity, to the right of it.
    pub across: f64,
    /// Factor on the listed loads.
    pub loads: f64,
    /// The robots' limits.
    pub limits: Limited,
}

/// What is changed about the robots' limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Limited {
    /// Nothing.
    AsGiven,
    /// Only what has no limit can give anything: what is left of the robots at loads without end.
    Unlimited,
    /// One limit of one robot.
    One {
        /// The robot.
        robot: RobotId,
        /// 0: force x, 1: force y, 2: torque.
        component: usize,
        /// The limit, N or N·m.
        most: f64,
    },
}

impl Default for Setting {
    fn default() -> Setting {
        Setting {
            friction: None,
            kernel: None,
            along: 1.0,
            across: 0.0,
            loads: 1.0,
            limits: Limited::AsGiven,
        }
    }
}

/// One group of a frame, to be changed and judged as often as wanted.
pub(super) struct Trial<'a> {
    given: &'a Scene,
    /// The scene as changed; only what concerns the group is kept up to date.
    changed: &'a mut Scene,
    frame: &'a Frame,
    /// The group's interfaces, and their friction as given.
    interfaces: Vec<Interface>,
    frictions: Vec<f64>,
    /// The group, its interfaces counted in `interfaces`.
    group: Group,
    /// The loads on the group.
    loads: Vec<Load>,
    length: f64,
    /// How many settings were judged.
    pub judged: usize,
}

impl<'a> Trial<'a> {
    /// A group of a frame; `changed` is a copy of the scene to work in.
    pub fn of(
        given: &'a Scene,
        changed: &'a mut Scene,
        frame: &'a Frame,
        interfaces: &[&Interface],
        group: &Group,
        length: f64,
    ) -> Trial<'a> {
        let interfaces: Vec<Interface> = group
            .interfaces
            .iter()
            .map(|i| interfaces[*i].clone())
            .collect();
        let on_group = |l: &&Load| group.blocks.contains(&l.block);
        Trial {
            given,
            changed,
            frame,
            frictions: interfaces.iter().map(|i| i.friction).collect(),
            group: Group {
                blocks: group.blocks.clone(),
                interfaces: (0..interfaces.len()).collect(),
                holds: group.holds.clone(),
            },
            interfaces,
            loads: given.loads.iter().filter(on_group).copied().collect(),
            length,
            judged: 0,
        }
    }

    /// The robots that hold a block of the group.
    pub fn holds(&self) -> Vec<RobotId> {
        self.group
            .holds
            .iter()
            .map(|h| self.frame.holds[*h].robot)
            .collect()
    }

    /// Whether the scene lists a load on the group.
    pub fn is_loaded(&self) -> bool {
        !self.loads.is_empty()
    }

    /// Whether some robot's limit is neither none nor infinite, so that twice the loads is not twice the forces.
    pub fn is_limited(&self) -> bool {
        self.holds().into_iter().any(|robot| {
            let limits = self.given.robots[robot.0].limits;
            [limits.fx, limits.fy, limits.torque]
                .into_iter()
                .any(|l| l > 0.0 && l.is_finite())
        })
    }

    /// Whether the changed group stands, and how it begins to move where it falls.
    pub fn judge(&mut self, setting: &Setting) -> (Verdict, Vec<Motion>) {
        self.judged += 1;
        let plan = self.change(setting);
        let interfaces: Vec<&Interface> = self.interfaces.iter().collect();
        judged(
            self.changed,
            self.frame,
            &interfaces,
            &plan,
            &self.group,
            self.length,
        )
    }

    /// The changed group's program.
    pub fn program(&mut self, setting: &Setting) -> Program {
        let plan = self.change(setting);
        let heaviest = heaviest(self.changed, &plan, &self.group, self.length);
        self.posed(&plan, Scale::of(self.length, heaviest))
    }

    /// The program at one setting, and what must be added to its need for another.
    pub fn direction(&mut self, from: &Setting, to: &Setting) -> (Program, Vec<f64>) {
        let mut most: f64 = 0.0;
        for setting in [from, to] {
            let plan = self.change(setting);
            most = most.max(heaviest(self.changed, &plan, &self.group, self.length));
        }
        let scale = Scale::of(self.length, most);
        let [there, here] = [to, from].map(|setting| {
            let plan = self.change(setting);
            self.posed(&plan, scale)
        });
        let toward = there.need.iter().zip(&here.need).map(|(a, b)| a - b);
        let toward = toward.collect();
        (here, toward)
    }

    fn posed(&self, plan: &Plan, scale: Scale) -> Program {
        let interfaces: Vec<&Interface> = self.interfaces.iter().collect();
        assemble(
            self.changed,
            self.frame,
            &interfaces,
            plan,
            &self.group,
            scale,
        )
    }

    fn change(&mut self, setting: &Setting) -> Plan {
        let (given, changed) = (self.given, &mut *self.changed);
        changed.kernel = setting.kernel.unwrap_or(given.kernel);
        // A weight along gravity and one across it are one weight along a turned gravity.
        let turned = given.down() * setting.along + quarter_turn(given.down()) * setting.across;
        changed.gravity = turned;
        for block in &self.group.blocks {
            changed.blocks[block.0].weight = given.blocks[block.0].weight
                * if setting.across == 0.0 {
                    setting.along.abs()
                } else {
                    libm::hypot(setting.along, setting.across)
                };
        }
        changed.loads.clear();
        changed.loads.extend(self.loads.iter().map(|l| Load {
            force: l.force * setting.loads,
            torque: l.torque * setting.loads,
            ..*l
        }));
        for hold in &self.group.holds {
            let number = self.frame.holds[*hold].robot;
            let limits = &mut changed.robots[number.0].limits;
            *limits = given.robots[number.0].limits;
            match setting.limits {
                Limited::AsGiven => {}
                Limited::Unlimited => {
                    for limit in [&mut limits.fx, &mut limits.fy, &mut limits.torque] {
                        if limit.is_finite() {
                            *limit = 0.0;
                        }
                    }
                }
                Limited::One {
                    robot,
                    component,
                    most,
                } if robot == number => match component {
                    0 => limits.fx = most,
                    1 => limits.fy = most,
                    _ => limits.torque = most,
                },
                Limited::One { .. } => {}
            }
        }
        for (interface, given) in self.interfaces.iter_mut().zip(&self.frictions) {
            interface.friction = setting.friction.unwrap_or(*given);
        }
        Plan::everything(changed.kernel)
    }
}
