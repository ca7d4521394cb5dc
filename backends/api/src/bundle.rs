//! Where a backend writes its files.
//!
//! Programs of a million cuts are hundreds of megabytes of text, so a backend streams: it opens one file after the
//! other in a [`Sink`] and hands over bytes in chunks. Whoever owns the sink decides what becomes of them; the
//! command line keeps them in temporary files until all are complete, tests keep them in a [`Bundle`].

use core::fmt;

/// Takes the files of one program, one after the other.
pub trait Sink {
    /// Starts the file `name` (a plain file name, no folders). The file before it is complete.
    ///
    /// # Errors
    /// When the sink cannot take it.
    fn file(&mut self, name: &str) -> Result<(), SinkError>;

    /// Appends bytes to the file started last.
    ///
    /// # Errors
    /// When the sink cannot take them.
    fn write(&mut self, bytes: &[u8]) -> Result<(), SinkError>;
}

/// Why a sink did not take something; the owner of the sink knows more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SinkError(pub String);

impl fmt::Display for SinkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Files kept in memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bundle {
    files: Vec<(String, Vec<u8>)>,
}

impl Bundle {
    /// The files in the order they were written: name and bytes.
    #[must_use]
    pub fn files(&self) -> &[(String, Vec<u8>)] {
        &self.files
    }

    /// The file of that name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files
            .iter()
            .find(|(file, _)| file == name)
            .map(|(_, bytes)| bytes.as_slice())
    }
}

impl Sink for Bundle {
    fn file(&mut self, name: &str) -> Result<(), SinkError> {
        if self.get(name).is_some() {
            return Err(SinkError(format!("file {name} is written twice")));
        }
        self.files.push((name.to_owned(), Vec::new()));
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), SinkError> {
        match self.files.last_mut() {
            Some((_, file)) => {
                file.extend_from_slice(bytes);
                Ok(())
            }
            None => Err(SinkError("bytes before the first file".to_owned())),
        }
    }
}
