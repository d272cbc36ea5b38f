//! An object of a peer: its methods by name, its signals and properties.

use std::sync::Arc;
use std::time::Duration;

use crate::error::QiError;
use crate::link::{EventChoice, MemberTarget, QiLink, Subscription};
use crate::meta::{MetaMethod, MetaObject};
use crate::signature::ValueSignature;
use crate::value::{ObjectRef, Value, encode_arguments};
use crate::wire::FLAG_DYNAMIC;

/// The longest time of a call unless something else is said.
pub const CALL_WITHIN: Duration = Duration::from_secs(2);
/// Objects of a service that are not the service itself begin here, and live until they are terminated.
const FIRST_TEMPORARY: u32 = 2;

/// Methods that every object has.
const META_OBJECT: u32 = 2;
const TERMINATE: u32 = 3;
const PROPERTY: u32 = 5;
const SET_PROPERTY: u32 = 6;

/// An object of a peer; clones are the same one. What a method gave out is terminated with the last clone.
#[derive(Debug, Clone)]
pub struct Object {
    link: QiLink,
    service: u32,
    object: u32,
    name: Arc<str>,
    meta: Arc<MetaObject>,
    within: Duration,
    _given_out: Option<Arc<GivenOut>>,
}

impl Object {
    /// The object at a place, which is asked what it can do.
    ///
    /// # Errors
    /// Fails as any call can.
    pub async fn at(link: QiLink, service: u32, object: u32, name: &str, within: Duration) -> Result<Self, QiError> {
        let target = MemberTarget { service, object, action: META_OBJECT };
        let answer = link.call(target, 0, object.to_le_bytes().to_vec(), within, "metaObject").await?;
        let meta = Arc::new(MetaObject::decode(answer.payload())?);
        Ok(Self { link, service, object, name: name.into(), meta, within, _given_out: None })
    }

    /// The object that a method of the peer at the end of `link` gave out, if `value` is one.
    pub fn from_value(link: &QiLink, value: &Value, within: Duration) -> Option<Self> {
        let ObjectRef { meta, service, object, .. } = value.as_object()?;
        let given_out = GivenOut { link: link.clone(), service: *service, object: *object };
        Some(Self {
            link: link.clone(),
            service: *service,
            object: *object,
            name: format!("object {object} of service {service}").into(),
            meta: Arc::new(meta.clone()),
            within,
            _given_out: (*object >= FIRST_TEMPORARY).then(|| Arc::new(given_out)),
        })
    }

    /// Returns the methods, signals and properties of the object.
    pub fn meta(&self) -> &MetaObject {
        &self.meta
    }

    /// The link it is reached by.
    pub fn link(&self) -> &QiLink {
        &self.link
    }

    /// The number of its service; another one after the service came back.
    pub fn service_id(&self) -> u32 {
        self.service
    }

    /// This object with another limit for every call.
    #[must_use]
    pub fn within(mut self, within: Duration) -> Self {
        self.within = within;
        self
    }

    /// Calls the method of this name that takes these arguments best, and waits for its result.
    ///
    /// # Errors
    /// [`QiError::NoMethod`], and what can go wrong with a call.
    pub async fn call(&self, name: &str, arguments: &[Value]) -> Result<Value, QiError> {
        self.call_within(name, arguments, self.within).await
    }

    /// [`Object::call`] with another limit for this one call.
    ///
    /// # Errors
    /// Fails as [`Object::call`] does.
    pub async fn call_within(&self, name: &str, arguments: &[Value], within: Duration) -> Result<Value, QiError> {
        let (method, flags, payload) = self.written(name, arguments)?;
        let what = format!("{}.{name}", self.name);
        let answer = self.link.call(self.target(method.uid), flags, payload, within, &what).await?;
        answer.value(&method.returns, self.link.layout())
    }

    /// [`Object::call_within`] until somebody does not want it any more: then the peer is asked to cancel it, if it can.
    ///
    /// # Errors
    /// Fails as [`Object::call`] does; with [`QiError::Canceled`] if it was not wanted any more.
    pub async fn call_until(
        &self,
        name: &str,
        arguments: &[Value],
        within: Duration,
        unwanted: impl Future<Output = ()>,
    ) -> Result<Value, QiError> {
        let (method, flags, payload) = self.written(name, arguments)?;
        let what = format!("{}.{name}", self.name);
        let target = self.target(method.uid);
        let answer = self.link.call_until(target, flags, payload, within, &what, unwanted).await?;
        answer.value(&method.returns, self.link.layout())
    }

    /// Calls a method that gives out an object.
    ///
    /// # Errors
    /// Fails as [`Object::call`] does; with [`QiError::Unexpected`] if it gives out something else.
    pub async fn call_object(&self, name: &str, arguments: &[Value]) -> Result<Self, QiError> {
        let value = self.call(name, arguments).await?;
        let object = Self::from_value(&self.link, &value, self.within);
        let what = format!("{}.{name}", self.name);
        object.ok_or(QiError::Unexpected { what, wanted: "an object" })
    }

    /// Calls a method whose result nobody wants. Never waits; whether it succeeded stays unknown.
    ///
    /// # Errors
    /// [`QiError::NoMethod`], [`QiError::Unfit`], [`QiError::Busy`], [`QiError::Disconnected`].
    pub fn post(&self, name: &str, arguments: &[Value]) -> Result<(), QiError> {
        let (method, flags, payload) = self.written(name, arguments)?;
        self.link.post(self.target(method.uid), flags, payload)
    }

    /// Listens to the signal of this name, or to the changes of a property.
    ///
    /// # Errors
    /// [`QiError::NoMember`], and those of [`QiLink::subscribe`].
    pub async fn subscribe(&self, signal: &str, keep: EventChoice) -> Result<Subscription, QiError> {
        let found = self.meta.signal(signal).ok_or_else(|| self.no_member("signal", signal))?;
        self.link.subscribe(self.target(found.uid), found.signature.clone(), keep, self.within).await
    }

    /// The value of a property.
    ///
    /// # Errors
    /// [`QiError::NoMember`], and what can go wrong with a call.
    pub async fn property(&self, name: &str) -> Result<Value, QiError> {
        self.meta.property(name).ok_or_else(|| self.no_member("property", name))?;
        let payload = self.written_dynamics(&[name.into()])?;
        let what = format!("{}.{name}", self.name);
        let answer = self.link.call(self.target(PROPERTY), 0, payload, self.within, &what).await?;
        Ok(match answer.value(&ValueSignature::Dynamic, self.link.layout())? {
            Value::Dynamic(inner) => *inner,
            other => other,
        })
    }

    /// Gives a property another value.
    ///
    /// # Errors
    /// [`QiError::NoMember`], and what can go wrong with a call.
    pub async fn set_property(&self, name: &str, value: Value) -> Result<(), QiError> {
        self.meta.property(name).ok_or_else(|| self.no_member("property", name))?;
        let payload = self.written_dynamics(&[name.into(), value])?;
        let what = format!("{}.{name}", self.name);
        self.link.call(self.target(SET_PROPERTY), 0, payload, self.within, &what).await?;
        Ok(())
    }

    fn written(&self, name: &str, arguments: &[Value]) -> Result<(&MetaMethod, u8, Vec<u8>), QiError> {
        let chosen = self.meta.choose(name, arguments).ok_or_else(|| QiError::NoMethod {
            object: self.name.to_string(),
            name: name.to_owned(),
            given: ValueSignature::tuple(arguments.iter().map(Value::signature).collect()).to_string(),
            candidates: self.meta.candidates(name),
        })?;
        let flags = if chosen.method.parameters == ValueSignature::Dynamic { FLAG_DYNAMIC } else { 0 };
        let payload = encode_arguments(arguments, &chosen.method.parameters, self.link.layout())?;
        Ok((chosen.method, flags, payload))
    }

    fn written_dynamics(&self, arguments: &[Value]) -> Result<Vec<u8>, QiError> {
        let signature = ValueSignature::tuple(vec![ValueSignature::Dynamic; arguments.len()]);
        Ok(encode_arguments(arguments, &signature, self.link.layout())?)
    }

    fn no_member(&self, what: &'static str, name: &str) -> QiError {
        QiError::NoMember { object: self.name.to_string(), what, name: name.to_owned() }
    }

    fn target(&self, action: u32) -> MemberTarget {
        MemberTarget { service: self.service, object: self.object, action }
    }
}

/// An object that the peer keeps for us until it is told that nobody needs it.
#[derive(Debug)]
struct GivenOut {
    link: QiLink,
    service: u32,
    object: u32,
}

impl Drop for GivenOut {
    fn drop(&mut self) {
        let target = MemberTarget { service: self.service, object: self.object, action: TERMINATE };
        // A link that is over took it along.
        let _gone = self.link.tell(target, self.object.to_le_bytes().to_vec());
    }
}
