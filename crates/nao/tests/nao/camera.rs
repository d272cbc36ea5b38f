//! Pictures of the camera: only while somebody looks, on a link of their own, and nothing is left behind.

use crate::driver::Driver;
use crate::peer::Peer;
use robot::Robot;
use serde_json::json;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn pictures_come_while_somebody_looks_and_end_with_that() {
    let Some(peer) = Peer::start("nao: camera", &[]).await else { return };
    let mut driver = Driver::at(&peer.address).await;
    let camera = driver.nao.camera().unwrap();
    assert_eq!(peer.state().await["cameras"], json!([]));
    camera.look(true);
    let looked = camera.clone();
    driver.until("a picture comes", |_| looked.picture(0).is_some()).await;
    let first = camera.picture(0).unwrap();
    assert_eq!((first.width, first.height), (320, 240));
    let red = |pixel: &[u8]| pixel[0] > 150 && pixel[1] < 90 && pixel[2] < 90;
    assert!(first.rgb.chunks(3).any(red), "the red ball before it is not in the picture");
    driver.until("the next one comes", |_| looked.picture(first.number).is_some()).await;
    camera.look(false);
    assert!(camera.picture(0).is_none());
    driver.sees(&peer, "no subscription is left", |state| state["cameras"] == json!([])).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_an_ended_server_left_behind_is_ended() {
    let Some(peer) = Peer::start("nao: camera left", &[]).await else { return };
    let address = format!("tcp://{}", peer.address).parse().unwrap();
    let session = qi::Session::connect(&address, qi::SessionOptions::default()).await.unwrap();
    let video = session.service("ALVideoDevice").await.unwrap();
    for name in ["rrp-test/camera", "somebody else"] {
        let choice = [0, 1, 11, 10].map(qi::Value::from);
        let arguments: Vec<qi::Value> = std::iter::once(name.into()).chain(choice).collect();
        video.call("subscribeCamera", &arguments).await.unwrap();
    }
    let mut driver = Driver::at(&peer.address).await;
    driver.sees(&peer, "ours is gone", |state| state["cameras"] == json!(["somebody else_0"])).await;
}
