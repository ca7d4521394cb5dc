//! Blocks that a job gives because only the builder of the machine knows them.

use crate::controller::{Codes, Facts};

/// What a block of the job is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// Tool-centre-point control on.
    TcpOn,
    /// Tool-centre-point control off.
    TcpOff,
    /// Generator on.
    On,
    /// Generator off.
    Off,
    /// Until the generator is ready.
    Ready,
}

impl Role {
    /// The option that gives it.
    pub(crate) const fn key(self) -> &'static str {
        match self {
            Self::TcpOn => "tcp_on",
            Self::TcpOff => "tcp_off",
            Self::On => "on_code",
            Self::Off => "off_code",
            Self::Ready => "ready_code",
        }
    }

    /// A block as a builder may choose it, for messages.
    pub(crate) fn example(self, facts: &Facts) -> &'static str {
        let [on, off, ready] = facts.example_codes;
        match self {
            Self::TcpOn => "M429",
            Self::TcpOff => "M428",
            Self::On => on,
            Self::Off => off,
            Self::Ready => ready,
        }
    }

    /// Whether it switches the kinematics, and not the generator.
    pub(crate) const fn is_of_kinematics(self) -> bool {
        match self {
            Self::TcpOn | Self::TcpOff => true,
            Self::On | Self::Off | Self::Ready => false,
        }
    }
}

impl<'p> Codes<'p> {
    /// The blocks of every role.
    pub(crate) const fn all(self) -> [(Role, &'p [String]); 5] {
        [
            (Role::TcpOn, self.tcp_on),
            (Role::TcpOff, self.tcp_off),
            (Role::On, self.on),
            (Role::Off, self.off),
            (Role::Ready, self.ready),
        ]
    }
}
