//! People who look through a robot's camera. While somebody asks for pictures a thread of its own fetches them, makes each
//! small once for all, and keeps only the newest; a moment after the last one asked it ends.

use super::status_feed::StatusFeed;
use crate::support::lock;
use crate::support::priority::{self, Priority};
use axum::body::Bytes;
use behaviour::Id;
use jpeg_encoder::{ColorType, Encoder};
use robot::{Camera, Picture};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// Pause between two looks for a new picture, in milliseconds: at most fifteen a second.
const EVERY_MS: u64 = 66;
/// The camera is let go when nobody asked for so long, in milliseconds.
const UNWATCHED_MS: u64 = 3_000;
/// How long a request waits for a new picture, in milliseconds.
const WAIT_MS: u64 = 2_000;
/// How well a picture is kept, from 1 to 100.
const QUALITY: u8 = 70;

/// The camera of one robot, if it has one, and who looks.
#[derive(Default)]
pub(super) struct CameraView {
    camera: Mutex<Option<Arc<dyn Camera>>>,
    /// When somebody asked last; none while no thread fetches pictures.
    asked: Mutex<Option<Instant>>,
    /// The newest picture as JPEG; none while nobody looks.
    newest: watch::Sender<Option<Bytes>>,
}

impl std::fmt::Debug for CameraView {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        to.debug_struct("CameraView").field("asked", &self.asked).finish_non_exhaustive()
    }
}

impl CameraView {
    /// Takes the camera of a robot that was made just now.
    pub(super) fn set(&self, camera: Option<Arc<dyn Camera>>) {
        *lock(&self.camera) = camera;
    }

    /// The next picture, as JPEG; none if there is none within two seconds.
    pub(super) async fn next(self: &Arc<Self>, robot: &Id, feed: &Arc<StatusFeed>) -> Option<Bytes> {
        let mut newest = self.newest.subscribe();
        newest.mark_unchanged();
        self.ask(robot, feed);
        let next = async {
            while newest.changed().await.is_ok() {
                let picture = newest.borrow_and_update().clone();
                if picture.is_some() {
                    return picture;
                }
            }
            None
        };
        tokio::time::timeout(Duration::from_millis(WAIT_MS), next).await.ok().flatten()
    }

    /// Notes that somebody looks; the first one begins the thread.
    fn ask(self: &Arc<Self>, robot: &Id, feed: &Arc<StatusFeed>) {
        if lock(&self.camera).is_none() {
            return;
        }
        let mut asked = lock(&self.asked);
        if asked.replace(Instant::now()).is_some() {
            return;
        }
        let (this, to, told) = (Arc::clone(self), robot.clone(), Arc::clone(feed));
        let thread = std::thread::Builder::new().name("camera".into());
        let spawned = thread.spawn(move || {
            priority::of_this_thread(Priority::Work);
            this.fetch(&to, &told);
        });
        if spawned.is_ok() {
            feed.edit(robot, |state| state.watched = true);
        } else {
            *asked = None;
        }
    }

    /// Fetches pictures until nobody asked for a while.
    fn fetch(&self, robot: &Id, feed: &StatusFeed) {
        let mut last = 0;
        while !self.ends(robot, feed) {
            // A robot that failed is made anew, and its camera with it.
            let camera = lock(&self.camera).clone();
            if let Some(camera) = camera {
                camera.look(true);
                if let Some(picture) = camera.picture(last) {
                    last = picture.number;
                    if let Some(small) = small(&picture) {
                        self.newest.send_replace(Some(small));
                    }
                }
            }
            std::thread::sleep(Duration::from_millis(EVERY_MS));
        }
    }

    /// Lets the camera go if nobody asked lately; true if so. Whoever asks meanwhile begins anew after that, so that what
    /// everyone is told is true.
    fn ends(&self, robot: &Id, feed: &StatusFeed) -> bool {
        let mut asked = lock(&self.asked);
        if asked.is_some_and(|at| at.elapsed() < Duration::from_millis(UNWATCHED_MS)) {
            return false;
        }
        if let Some(camera) = lock(&self.camera).as_ref() {
            camera.look(false);
        }
        self.newest.send_replace(None);
        feed.edit(robot, |state| state.watched = false);
        *asked = None;
        true
    }
}

/// A picture as JPEG.
fn small(picture: &Picture) -> Option<Bytes> {
    let mut bytes = Vec::new();
    let encoder = Encoder::new(&mut bytes, QUALITY);
    encoder.encode(&picture.rgb, picture.width, picture.height, ColorType::Rgb).ok()?;
    Some(bytes.into())
}

#[cfg(test)]
mod tests {
    use super::{CameraView, StatusFeed};
    use behaviour::Id;
    use protocol::RobotState;
    use robot::{Camera, Picture};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

    /// A camera with another picture at every look.
    #[derive(Default)]
    struct Grey {
        looks: AtomicBool,
        count: AtomicU64,
    }

    impl Camera for Grey {
        fn look(&self, looks: bool) {
            self.looks.store(looks, Ordering::SeqCst);
        }

        fn picture(&self, after: u64) -> Option<Arc<Picture>> {
            let number = self.count.fetch_add(1, Ordering::SeqCst) + 1;
            assert!(number > after);
            Picture::new(number, [16, 16], vec![90; 16 * 16 * 3]).map(Arc::new)
        }
    }

    #[tokio::test]
    async fn a_camera_looks_while_somebody_asks_and_everyone_is_told() {
        let (feed, robot) = (Arc::new(StatusFeed::default()), Id::new("nao").unwrap());
        feed.add(RobotState::connecting(robot.clone(), "NAO".into()));
        let (view, grey) = (Arc::new(CameraView::default()), Arc::new(Grey::default()));
        assert!(view.next(&robot, &feed).await.is_none(), "a robot without a camera");
        view.set(Some(Arc::clone(&grey) as Arc<dyn Camera>));
        let picture = view.next(&robot, &feed).await.expect("it looks");
        assert_eq!(&picture[..3], [0xFF, 0xD8, 0xFF], "a JPEG");
        assert!(feed.robots().borrow()[0].watched && grey.looks.load(Ordering::SeqCst));
        let mut robots = feed.robots();
        let told = robots.wait_for(|robots| !robots[0].watched).await;
        drop(told.expect("it ends by itself"));
        assert!(!grey.looks.load(Ordering::SeqCst));
        assert!(view.next(&robot, &feed).await.is_some(), "and begins anew");
    }
}
