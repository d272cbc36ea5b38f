//! The picture of the top camera, on a link of its own that is there only while somebody looks: a picture is large, and what
//! comes behind it on a link waits for it.

use crate::connecting::find;
use crate::settings::RobotSettings;
use crate::shared::NaoShared;
use qi::{Object, QiError, Session, Value};
use robot::{Camera, Picture};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::time::MissedTickBehavior;

/// The service of the cameras.
const VIDEO: &str = "ALVideoDevice";
/// The top camera, at 320 x 240 (`kQVGA`), in `kRGBColorSpace`, ten pictures a second.
const CHOICE: [i32; 4] = [0, 1, 11, 10];
/// Pause between two pictures, in milliseconds: ten a second.
const EVERY_MS: u64 = 100;
/// The longest that a picture may take on its way.
const PICTURE: Duration = Duration::from_secs(3);
/// The longest that it may take to say that no more pictures are wanted.
const LEAVE: Duration = Duration::from_secs(1);
/// Pause before the link is made again, in milliseconds.
const AGAIN_MS: u64 = 1_000;

/// The camera of one robot. A clone is the same one.
#[derive(Clone)]
pub(crate) struct NaoCamera(Arc<CameraInner>);

struct CameraInner {
    settings: RobotSettings,
    shared: Arc<NaoShared>,
    seen: Mutex<SeenPictures>,
}

/// The pictures that are seen, and the wish to see some.
#[derive(Default)]
struct SeenPictures {
    looks: bool,
    /// True if there is a thread that fetches pictures.
    fetches: bool,
    newest: Option<Arc<Picture>>,
    /// The number of pictures that came so far.
    count: u64,
}

impl NaoCamera {
    pub(crate) fn new(settings: RobotSettings, shared: Arc<NaoShared>) -> Self {
        Self(Arc::new(CameraInner { settings, shared, seen: Mutex::default() }))
    }
}

impl Camera for NaoCamera {
    fn look(&self, looks: bool) {
        let mut seen = self.0.seen();
        seen.looks = looks;
        if !looks {
            seen.newest = None;
        }
        if !looks || seen.fetches {
            return;
        }
        let inner = Arc::clone(&self.0);
        let thread = std::thread::Builder::new().name("nao-camera".into());
        // Without a thread there is no picture, and the next look tries again.
        seen.fetches = thread.spawn(move || inner.fetch()).is_ok();
    }

    fn picture(&self, after: u64) -> Option<Arc<Picture>> {
        self.0.seen().newest.clone().filter(|picture| picture.number > after)
    }
}

impl CameraInner {
    fn seen(&self) -> MutexGuard<'_, SeenPictures> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// False once nobody looks or the robot is not used any more.
    fn is_wanted(&self) -> bool {
        self.seen().looks && !self.shared.ended.load(Ordering::SeqCst)
    }

    /// Fetches pictures until nobody looks.
    fn fetch(&self) {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        if let Ok(runtime) = runtime {
            loop {
                runtime.block_on(self.work());
                let mut seen = self.seen();
                // Who began to look at this very moment goes on with this thread.
                if !seen.looks || self.shared.ended.load(Ordering::SeqCst) {
                    seen.fetches = false;
                    return;
                }
            }
        }
        self.seen().fetches = false;
    }

    async fn work(&self) {
        while self.is_wanted() {
            if self.shared.state().is_linked()
                && let Err(error) = self.serve().await
            {
                tracing::debug!(%error, "no pictures of the camera");
            }
            self.seen().newest = None;
            for _ in 0..AGAIN_MS / EVERY_MS {
                if self.is_wanted() {
                    tokio::time::sleep(Duration::from_millis(EVERY_MS)).await;
                }
            }
        }
    }

    /// Until nobody looks or the robot is away.
    async fn serve(&self) -> Result<(), QiError> {
        let (_, session) = find(&self.settings).await?;
        let video = session.service(VIDEO).await?;
        let name = name(&self.settings.own_name);
        let choice = CHOICE.map(Value::from);
        let arguments: Vec<Value> = std::iter::once(name.as_str().into()).chain(choice).collect();
        let handle = video.call("subscribeCamera", &arguments).await?;
        let fetched = self.fetch_all(&video, &handle).await;
        let _ = video.call_within("unsubscribe", &[handle], LEAVE).await;
        session.link().close();
        fetched
    }

    async fn fetch_all(&self, video: &Object, handle: &Value) -> Result<(), QiError> {
        let mut beat = tokio::time::interval(Duration::from_millis(EVERY_MS));
        beat.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut last = None;
        while self.is_wanted() && self.shared.state().is_linked() {
            beat.tick().await;
            let image = video.call_within("getImageRemote", std::slice::from_ref(handle), PICTURE).await?;
            let taken = image.items().and_then(|parts| Some((parts.get(4)?.as_i64()?, parts.get(5)?.as_i64()?)));
            // A camera that is asked more often than it takes pictures gives one twice.
            if taken.is_some() && taken == last {
                continue;
            }
            last = taken;
            let mut seen = self.seen();
            if let Some(picture) = read(&image, seen.count + 1).filter(|_| seen.looks) {
                seen.count += 1;
                seen.newest = Some(Arc::new(picture));
            }
        }
        Ok(())
    }
}

/// Returns the name under which pictures are asked for. A subscription outlives the process that made it, so the name
/// is found by it again.
fn name(own_name: &str) -> String {
    format!("{own_name}/camera")
}

/// Ends the subscriptions that an ended server left behind: of one name there may be six only.
pub(crate) async fn clean(session: &Session, settings: &RobotSettings) {
    let Ok(video) = session.service(VIDEO).await else { return };
    let Ok(known) = video.call("getSubscribers", &[]).await else { return };
    let ours: Vec<String> = settings.names().map(|own| format!("{}_", name(own))).collect();
    for handle in known.items().unwrap_or_default().iter().filter_map(Value::as_text) {
        if ours.iter().any(|ours| handle.starts_with(ours)) {
            let _ = video.call("unsubscribe", &[handle.as_ref().into()]).await;
        }
    }
}

/// A picture of an image: `[width, height, layers, colours, seconds, microseconds, bytes, ...]`.
fn read(image: &Value, number: u64) -> Option<Picture> {
    let parts = image.items()?;
    let side = |at: usize| parts.get(at)?.as_u32().and_then(|side| u16::try_from(side).ok());
    Picture::new(number, [side(0)?, side(1)?], parts.get(6)?.as_bytes()?.to_vec())
}

#[cfg(test)]
mod tests {
    use super::read;
    use qi::Value;

    fn image(width: i32, bytes: usize) -> Value {
        let head = [width, 2, 3, 11, 0, 0].map(Value::from);
        Value::List(head.into_iter().chain([Value::Raw(vec![7; bytes])]).collect())
    }

    #[test]
    fn an_image_is_read_only_if_it_is_whole() {
        let picture = read(&image(4, 24), 5).expect("whole");
        assert_eq!((picture.number, picture.width, picture.height), (5, 4, 2));
        assert!(read(&image(4, 23), 5).is_none() && read(&image(-4, 24), 5).is_none());
        assert!(read(&Value::Unit, 5).is_none());
    }
}
