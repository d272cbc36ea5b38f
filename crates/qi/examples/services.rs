//! Lists the services of a peer and calls one: `cargo run -p qi --example services -- tcp://HOST:PORT [SERVICE METHOD [TEXT]]`.
#![expect(clippy::print_stdout, reason = "an example speaks on standard output")]

use qi::{QiError, Session, SessionOptions, Value};

#[tokio::main]
async fn main() -> Result<(), QiError> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let [address, call @ ..] = words.as_slice() else {
        println!("services tcp://HOST:PORT [SERVICE METHOD [TEXT]]");
        return Ok(());
    };
    let session = Session::connect(&address.parse()?, SessionOptions::default()).await?;
    for service in session.services().await? {
        println!("{:>4} {} {}", service.service_id, service.name, service.endpoints.join(" "));
    }
    if let [service, method, arguments @ ..] = call {
        let arguments: Vec<Value> = arguments.iter().map(|text| Value::from(*text)).collect();
        println!("{:?}", session.service(service).await?.call(method, &arguments).await?);
    }
    Ok(())
}
