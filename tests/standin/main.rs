//! The stand-in for a NAO on the real libqi, `nao.py`: that it does what other tests believe of it.

mod body;
mod calls;
mod nao;
mod senses;
mod simulated;
