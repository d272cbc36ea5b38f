//! From the text of a body to what Rhai has read, if it is one that may run.

use crate::faults::{BodyFault, Syntax};
use crate::procedure::walk;
use behaviour::{BODY_MAX_CHARS, as_meant};
use rhai::{AST, Dynamic, Engine, Position, Scope, Token};

/// The most blocks of their own in one body.
const BLOCKS_MAX: usize = 200;

/// Compiles a body by itself.
pub(crate) fn compile(engine: &Engine, names: &[String], body: &str) -> Result<AST, BodyFault> {
    if body.trim().is_empty() {
        return Err(BodyFault::Empty);
    }
    if body.chars().count() > BODY_MAX_CHARS {
        return Err(BodyFault::TooLong);
    }
    if bare_blocks(engine, body) > BLOCKS_MAX {
        return Err(BodyFault::Blocks(BLOCKS_MAX));
    }
    let scope = scope_of(names);
    let ast = engine.compile_with_scope(&scope, body).map_err(|error| match as_meant(body, names) {
        meant if meant.is_empty() => BodyFault::Syntax(Syntax::of(error, names)),
        meant => BodyFault::LooksRight(meant),
    })?;
    walk::check_calls(&ast)?;
    Ok(ast)
}

/// Counts the blocks that stand where a statement begins: Rhai takes them apart one after the other, and goes through
/// all that stands beside them for each.
fn bare_blocks(engine: &Engine, body: &str) -> usize {
    if body.matches('{').count() <= BLOCKS_MAX {
        return 0;
    }
    let mut begins = true;
    let is_bare = |(token, _): (Token, Position)| {
        let is_bare = begins && token == Token::LeftBrace;
        begins = matches!(token, Token::SemiColon | Token::LeftBrace | Token::RightBrace);
        is_bare
    };
    let texts = [body];
    // The end is given again and again, and what cannot be read is refused anyway.
    let is_text = |(token, _): &(Token, Position)| !matches!(token, Token::EOF | Token::LexError(_));
    engine.lex(&texts).0.take_while(is_text).map(is_bare).filter(|is_bare| *is_bare).count()
}

pub(super) fn scope_of(names: &[String]) -> Scope<'static> {
    let mut scope = Scope::with_capacity(names.len());
    for name in names {
        scope.push_dynamic(name.as_str(), Dynamic::UNIT);
    }
    scope
}
