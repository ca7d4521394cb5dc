//! Tracks of a disc on a surface: ways on which height and posture change with y.
//!
//! What holds of them is found from poses alone, those of a plan or those of a program:
//!
//! | Question | Here |
//! | --- | --- |
//! | does the disc enter the part in its poses, or between them | [`entry`] |
//! | what comes free, and what stays, in sections across the tracks | [`sections`] |
//! | both of a program, as findings | [`proof`] |

pub mod entry;
pub mod proof;
pub mod sections;
pub mod way;
