//! What `docs/backends.md` shows is so: its program answers its request with its reply, and its types take all of it.

use crate::repository::read;
use serde_json::Value;
use std::io::Write;
use std::process::{Command, Stdio};
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::protocol::{Ask, Description, Emitted, PROTOCOL_VERSION, ReadBack, Request};
use vcutc_backend_api::readback::{self, Effect};

/// The only blocks of that language on the page.
fn blocks(language: &str) -> Vec<String> {
    let page = read("docs/backends.md");
    let begins = format!("```{language}\n");
    let blocks = page.split(&begins).skip(1);
    blocks
        .map(|rest| rest.split("```").next().unwrap().to_owned())
        .collect()
}

/// What the program of the page answers.
fn answer(request: &Value) -> Value {
    let [program] = blocks("python").try_into().expect("one program");
    let mut child = Command::new("python3")
        .args(["-c", &program])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the example is in Python");
    let question = serde_json::to_vec(request).unwrap();
    child.stdin.take().unwrap().write_all(&question).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    serde_json::from_slice(&output.stdout).unwrap()
}

fn conversation() -> [Value; 2] {
    let blocks: [String; 2] = blocks("json").try_into().expect("a request and a reply");
    blocks.map(|block| serde_json::from_str(&block).unwrap())
}

#[test]
fn the_program_of_the_page_answers_its_request_with_its_reply() {
    let [request, reply] = conversation();
    assert_eq!(answer(&request), reply);
}

#[test]
fn the_request_of_the_page_is_what_the_compiler_writes() {
    let [request, reply] = conversation();
    let typed: Request<'_> = serde_json::from_value(request.clone()).unwrap();
    assert_eq!(serde_json::to_value(&typed).unwrap(), request);
    assert_eq!(typed.protocol, PROTOCOL_VERSION);
    let Ask::Emit(emit) = &typed.ask else {
        panic!("{typed:?}")
    };
    let program: &Program = &emit.program.program;
    let reply: Emitted = serde_json::from_value(reply).unwrap();
    assert_eq!(reply.said.len(), program.ops.len());
}

#[test]
fn the_program_of_the_page_describes_itself_and_reads_what_it_wrote() {
    let [request, reply] = conversation();
    let ask = |question: Value| {
        let mut asked = request.clone();
        asked
            .as_object_mut()
            .unwrap()
            .extend(question.as_object().unwrap().clone());
        answer(&asked)
    };
    let described: Description = serde_json::from_value(ask(serde_json::json!({"ask": "describe"}))).unwrap();
    assert_eq!(described.id, "deeds");
    let read = ask(serde_json::json!({"ask": "read", "files": reply["files"]}));
    let read: ReadBack = serde_json::from_value(read).unwrap();
    let [statement] = read.statements.as_slice() else {
        panic!("{read:?}")
    };
    let Effect::Command(readback::Command::Axes(axes)) = statement.effect else {
        panic!("{statement:?}")
    };
    assert_eq!(axes.0, [0.5, 0.0, 0.0, 0.0, 0.0, 0.0]);
}
