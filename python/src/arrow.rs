//! A table of columns for whoever speaks Arrow: the C stream interface
//! (<https://arrow.apache.org/docs/format/CStreamInterface.html>), one batch. pandas, polars,
//! pyarrow and DuckDB take it without a copy of the numbers.
//!
//! A batch is a struct array; its children are columns of `int64`, `float64` or text (`utf8`,
//! 32-bit offsets). No column has nulls. Whoever imports an array or a schema calls its `release`
//! once; what backs the buffers is kept by the array until then.

use std::{
    ffi::{CString, c_char, c_int, c_void},
    ptr,
    sync::Arc,
};

/// A column's numbers or words.
#[derive(Debug)]
pub enum Column {
    Whole(Vec<i64>),
    Real(Vec<f64>),
    /// Ends of the words in the text, from 0, and the text.
    Words(Vec<i32>, Vec<u8>),
}

impl Column {
    /// Words, one a row.
    pub fn words<'a>(all: impl Iterator<Item = &'a str>) -> Self {
        let (mut ends, mut text) = (vec![0], Vec::new());
        for word in all {
            text.extend_from_slice(word.as_bytes());
            // 2 GB of names: more rows than there is memory for
            ends.push(i32::try_from(text.len()).unwrap_or(i32::MAX));
        }
        Self::Words(ends, text)
    }

    pub fn word(&self, i: usize) -> Option<&str> {
        let Self::Words(ends, text) = self else { return None };
        let at = |k: usize| ends.get(k).and_then(|end| usize::try_from(*end).ok());
        std::str::from_utf8(text.get(at(i)?..at(i + 1)?)?).ok()
    }

    fn format(&self) -> &'static str {
        match self {
            Self::Whole(_) => "l",
            Self::Real(_) => "g",
            Self::Words(..) => "u",
        }
    }

    fn buffers(&self) -> Vec<*const c_void> {
        // the first would say which rows are null
        let mut buffers = vec![ptr::null()];
        match self {
            Self::Whole(x) => buffers.push(x.as_ptr().cast()),
            Self::Real(x) => buffers.push(x.as_ptr().cast()),
            Self::Words(ends, text) => buffers.extend([ends.as_ptr().cast(), text.as_ptr().cast()]),
        }
        buffers
    }
}

/// Named columns of one length.
#[derive(Debug)]
pub struct Columns {
    pub rows: usize,
    pub all: Vec<(&'static str, Column)>,
}

#[repr(C)]
struct ArrowSchema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    n_children: i64,
    children: *mut *mut ArrowSchema,
    dictionary: *mut ArrowSchema,
    release: Option<unsafe extern "C" fn(*mut ArrowSchema)>,
    private_data: *mut c_void,
}

#[repr(C)]
struct ArrowArray {
    length: i64,
    null_count: i64,
    offset: i64,
    n_buffers: i64,
    n_children: i64,
    buffers: *mut *const c_void,
    children: *mut *mut ArrowArray,
    dictionary: *mut ArrowArray,
    release: Option<unsafe extern "C" fn(*mut ArrowArray)>,
    private_data: *mut c_void,
}

/// The stream; `repr(C)` as the interface has it.
#[repr(C)]
pub struct ArrowArrayStream {
    get_schema: Option<unsafe extern "C" fn(*mut ArrowArrayStream, *mut ArrowSchema) -> c_int>,
    get_next: Option<unsafe extern "C" fn(*mut ArrowArrayStream, *mut ArrowArray) -> c_int>,
    get_last_error: Option<unsafe extern "C" fn(*mut ArrowArrayStream) -> *const c_char>,
    release: Option<unsafe extern "C" fn(*mut ArrowArrayStream)>,
    private_data: *mut c_void,
}

// SAFETY: what a stream points to is owned by it alone and may be used from any thread
unsafe impl Send for ArrowArrayStream {}

/// What a stream holds.
struct Source {
    columns: Arc<Columns>,
    given: bool,
}

impl ArrowArrayStream {
    /// One batch of these columns.
    pub fn of(columns: Arc<Columns>) -> Self {
        Self {
            get_schema: Some(get_schema),
            get_next: Some(get_next),
            get_last_error: Some(get_last_error),
            release: Some(release_stream),
            private_data: Box::into_raw(Box::new(Source { columns, given: false })).cast(),
        }
    }
}

impl Drop for ArrowArrayStream {
    fn drop(&mut self) {
        // a consumer that moved the stream out has taken its release with it
        if let Some(release) = self.release {
            // SAFETY: it has not been called, for it would have cleared itself
            unsafe { release(self) }
        }
    }
}

unsafe extern "C" fn get_schema(stream: *mut ArrowArrayStream, out: *mut ArrowSchema) -> c_int {
    // SAFETY: the consumer hands over a live stream of ours and room for a schema
    unsafe {
        let source = &*(*stream).private_data.cast::<Source>();
        let child = |(name, column): &(&str, Column)| {
            Box::into_raw(Box::new(schema(column.format(), name, Vec::new())))
        };
        ptr::write(out, schema("+s", "", source.columns.all.iter().map(child).collect()));
    }
    0
}

unsafe extern "C" fn get_next(stream: *mut ArrowArrayStream, out: *mut ArrowArray) -> c_int {
    // SAFETY: as above; an array whose release is null is the end
    unsafe {
        let source = &mut *(*stream).private_data.cast::<Source>();
        let batch = if std::mem::replace(&mut source.given, true) {
            ended()
        } else {
            batch(&source.columns)
        };
        ptr::write(out, batch);
    }
    0
}

unsafe extern "C" fn get_last_error(_: *mut ArrowArrayStream) -> *const c_char {
    ptr::null()
}

unsafe extern "C" fn release_stream(stream: *mut ArrowArrayStream) {
    // SAFETY: called once, as the interface demands
    unsafe {
        drop(Box::from_raw((*stream).private_data.cast::<Source>()));
        (*stream).release = None;
    }
}

/// What a schema owns: its texts and its children.
struct SchemaParts {
    _texts: [CString; 2],
    children: Vec<*mut ArrowSchema>,
}

fn schema(format: &str, name: &str, children: Vec<*mut ArrowSchema>) -> ArrowSchema {
    let texts = [format, name].map(|text| CString::new(text).unwrap_or_default());
    let pointers = [texts[0].as_ptr(), texts[1].as_ptr()];
    let mut parts = Box::new(SchemaParts { _texts: texts, children });
    let (n_children, children) = (parts.children.len() as i64, parts.children.as_mut_ptr());
    ArrowSchema {
        format: pointers[0],
        name: pointers[1],
        metadata: ptr::null(),
        flags: 0,
        n_children,
        children,
        dictionary: ptr::null_mut(),
        release: Some(release_schema),
        private_data: Box::into_raw(parts).cast(),
    }
}

unsafe extern "C" fn release_schema(of: *mut ArrowSchema) {
    // SAFETY: called once; a child that was moved out has no release any more
    unsafe {
        let parts = Box::from_raw((*of).private_data.cast::<SchemaParts>());
        for child in &parts.children {
            let mut child = Box::from_raw(*child);
            if let Some(release) = child.release {
                release(&mut *child);
            }
        }
        (*of).release = None;
    }
}

/// What an array owns: the columns that its buffers lie in, the list of them, its children.
struct ArrayParts {
    _columns: Arc<Columns>,
    buffers: Vec<*const c_void>,
    children: Vec<*mut ArrowArray>,
}

fn array(
    columns: &Arc<Columns>,
    buffers: Vec<*const c_void>,
    children: Vec<*mut ArrowArray>,
) -> ArrowArray {
    let mut parts = Box::new(ArrayParts { _columns: columns.clone(), buffers, children });
    let (n_buffers, n_children) = (parts.buffers.len() as i64, parts.children.len() as i64);
    let (buffers, children) = (parts.buffers.as_mut_ptr(), parts.children.as_mut_ptr());
    ArrowArray {
        length: columns.rows as i64,
        null_count: 0,
        offset: 0,
        n_buffers,
        n_children,
        buffers,
        children,
        dictionary: ptr::null_mut(),
        release: Some(release_array),
        private_data: Box::into_raw(parts).cast(),
    }
}

fn batch(columns: &Arc<Columns>) -> ArrowArray {
    let child = |(_, column): &(&str, Column)| {
        Box::into_raw(Box::new(array(columns, column.buffers(), Vec::new())))
    };
    array(columns, vec![ptr::null()], columns.all.iter().map(child).collect())
}

fn ended() -> ArrowArray {
    ArrowArray {
        length: 0,
        null_count: 0,
        offset: 0,
        n_buffers: 0,
        n_children: 0,
        buffers: ptr::null_mut(),
        children: ptr::null_mut(),
        dictionary: ptr::null_mut(),
        release: None,
        private_data: ptr::null_mut(),
    }
}

unsafe extern "C" fn release_array(of: *mut ArrowArray) {
    // SAFETY: as for a schema
    unsafe {
        let parts = Box::from_raw((*of).private_data.cast::<ArrayParts>());
        for child in &parts.children {
            let mut child = Box::from_raw(*child);
            if let Some(release) = child.release {
                release(&mut *child);
            }
        }
        (*of).release = None;
    }
}
