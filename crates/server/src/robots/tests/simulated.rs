//! The robots of the server as people have them: the simulated NAO.

use super::until;
use crate::library::templates::templates;
use crate::recordings::Recordings;
use crate::robots::{Robots, StartOrder};
use behaviour::Id;
use robot::{Health, SceneEdit};

#[tokio::test]
async fn a_green_ball_makes_the_eyes_green() {
    let robots = Robots::within(None, (1, 0), Recordings::default()).unwrap();
    let nao = robots.meant(None).unwrap();
    let file = templates()[0].file();
    let behaviour = Id::new("reflect").unwrap();
    nao.start(StartOrder {
        behaviour,
        revision: 3,
        file: file.into(),
        record: false,
        session: protocol::RecordedSession::default(),
        by: "Aiko".to_owned(),
        invitation: None,
    })
    .await
    .unwrap();
    for (ball, at) in [("red", [-1.0, 0.5, 0.1]), ("blue", [-1.0, -0.5, 0.1]), ("green", [0.6, 0.0, 0.45])] {
        robots.edit_scene(None, SceneEdit::MoveBall { id: ball.to_owned(), at });
    }
    let scene = nao.scene();
    until("green eyes", || {
        let [red, green, blue] = scene.borrow().body.eyes;
        green > 0.5 && red < 0.1 && blue < 0.1
    })
    .await;
    assert_eq!(robots.states().borrow()[0].health, Health::Ready);
    assert!(robots.stop(None, None, "Aiko"));
    robots.shut_down();
}
