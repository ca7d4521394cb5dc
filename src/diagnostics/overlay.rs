//! Texts that stand in for files: open documents, drafts and changes that are tried.

use crate::source::{Entry, LoadError, Loader};
use std::collections::BTreeMap;

/// Texts by their paths, over the files that there are.
pub struct Overlay<'o, T> {
    pub texts: &'o BTreeMap<String, T>,
    pub below: &'o dyn Loader,
}

impl<T: AsRef<str>> Loader for Overlay<'_, T> {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        match self.texts.get(path) {
            Some(text) => Ok(text.as_ref().as_bytes().to_vec()),
            None => self.below.load(path),
        }
    }

    fn load_data(&self, path: &str, most: u64) -> Result<Vec<u8>, LoadError> {
        match self.texts.get(path) {
            Some(text) => Ok(text.as_ref().as_bytes().to_vec()),
            None => self.below.load_data(path, most),
        }
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        self.below.list(folder)
    }
}
