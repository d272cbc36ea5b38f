//! The robot in its room as a picture.

use crate::model::ArmSide;
use crate::nao::SimulatedNao;
use crate::nao::devices::{FollowingBody, PointingArm};
use crate::room::MARK_M;
use crate::world::{self, BallBody, ObstacleBody, PersonBody};
use robot::{Ball, Body, Obstacle, PrintedMark, Scene, ScenePerson};

impl SimulatedNao {
    /// Everything in the room now.
    pub(crate) fn picture(&self) -> Scene {
        Scene {
            at_ms: self.now,
            body: self.body_picture(),
            balls: self.ball_pictures(),
            people: self.people_pictures(),
            obstacles: self.obstacle_pictures(),
            landmarks: self.landmark_pictures(),
        }
    }

    fn body_picture(&self) -> Body {
        let hands = [ArmSide::Left, ArmSide::Right].map(|side| self.body.hand(side).to_array());
        Body {
            base: self.base.at,
            joints: self.servo.now.to_vec(),
            eyes: self.eyes.shine(),
            saying: self.speech.saying().to_owned(),
            tracking: self.tracking(),
            printed: self.printed.iter().cloned().collect(),
            gaze: self.body.gaze(),
            gaze_half: self.model.camera.half[0],
            hands,
            torso: [self.body.height(), self.lean.angle],
            touched: self.pads.touched(),
            battery: self.charge.percent(),
            plugged: self.charge.plugged,
            posture: self.family().to_owned(),
            fallen: self.lean.is_fallen(),
            playing: self.playing_words(),
            lights: self.lights.shine(),
            heard: self.hearing.words.as_deref().unwrap_or_default().to_owned(),
        }
    }

    fn tracking(&self) -> String {
        let head = self.follow.iter().map(FollowingBody::words);
        let arms = self.points.iter().map(PointingArm::words);
        head.chain(arms).collect::<Vec<_>>().join(", ")
    }

    fn playing_words(&self) -> String {
        let gesture = self.playing.iter().map(|playing| playing.words());
        gesture.chain(self.sounds.playing()).collect::<Vec<_>>().join(", ")
    }

    fn ball_pictures(&self) -> Vec<Ball> {
        let picture = |(index, ball): (usize, &BallBody)| Ball {
            id: ball.color.to_owned(),
            color: ball.color.to_owned(),
            at: self.world.ball_at(ball).to_array(),
            radius: ball.radius,
            seen: self.ball_in_view(index).is_some(),
        };
        self.world.balls.iter().enumerate().map(picture).collect()
    }

    fn people_pictures(&self) -> Vec<ScenePerson> {
        let picture = |(index, person): (usize, &PersonBody)| ScenePerson {
            id: person.id.to_owned(),
            at: person.at,
            height: person.height,
            seen: self.face_in_view(index).is_some(),
            known: self.known[index],
            present: person.present,
        };
        self.world.people.iter().enumerate().map(picture).collect()
    }

    fn obstacle_pictures(&self) -> Vec<Obstacle> {
        let picture = |obstacle: &ObstacleBody| Obstacle {
            id: obstacle.id.to_owned(),
            color: obstacle.color.to_owned(),
            at: obstacle.at,
            size: obstacle.size,
            present: obstacle.present,
        };
        self.world.obstacles.iter().map(picture).collect()
    }

    fn landmark_pictures(&self) -> Vec<PrintedMark> {
        let picture = |(index, mark): (usize, &world::WorldMark)| PrintedMark {
            id: mark.id.to_owned(),
            number: mark.number,
            at: mark.at.to_array(),
            facing: mark.facing,
            radius: MARK_M,
            seen: self.mark_in_view(index).is_some(),
            present: mark.present,
        };
        self.world.marks.iter().enumerate().map(picture).collect()
    }
}
