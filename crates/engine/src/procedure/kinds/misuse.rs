//! Objects in a procedure that are compared with a number or reckoned with: that is false for ever, or fails.

use super::KindReader;
use super::known::parsed;
use super::operators::wants_numbers;
use crate::cost::nodes::each_node;
use behaviour::{HelperCall, ValueType};
use rhai::{ASTNode, Expr, FnCallExpr, Stmt};

/// The first argument of these kinds that is an object and stands beside a number in an operator of numbers, and how often
/// such arguments do; nothing at every doubt.
#[must_use]
pub fn misused(arguments: &[(String, ValueType)], body: &str, helper: HelperCall) -> Option<(String, usize)> {
    let names: Vec<String> = arguments.iter().map(|(name, _)| name.clone()).collect();
    let ast = parsed(&names, body).ok().filter(|ast| !ast.has_functions())?;
    let (mut found, mut declares) = (Vec::new(), false);
    each_node(&ast, &mut |path: &[ASTNode]| {
        match path.last() {
            Some(ASTNode::Expr(Expr::FnCall(call, _)) | ASTNode::Stmt(Stmt::FnCall(call, _))) => {
                found.extend(object_beside_number(call, arguments, helper));
            }
            // A variable of its own may have the name of an argument.
            Some(ASTNode::Stmt(Stmt::Var(..) | Stmt::Assignment(..) | Stmt::For(..))) => declares = true,
            _ => {}
        }
        !declares
    });
    let first = found.first().filter(|_| !declares)?;
    let times = found.iter().filter(|name| *name == first).count();
    Some(((*first).to_owned(), times))
}

fn object_beside_number<'a>(
    call: &FnCallExpr,
    arguments: &'a [(String, ValueType)],
    helper: HelperCall,
) -> Option<&'a str> {
    let [one, other] = &call.args[..] else { return None };
    if !call.op_token.as_ref().is_some_and(wants_numbers) {
        return None;
    }
    let object = |of: &Expr| match of {
        Expr::Variable(variable, ..) => {
            let (name, kind) = arguments.iter().find(|(name, _)| *name == variable.1.as_str())?;
            matches!(kind, ValueType::Record(_)).then_some(name.as_str())
        }
        _ => None,
    };
    let is_number = |of: &Expr| {
        let mut reader = KindReader { names: arguments.to_vec(), helper, depth: 0, parts: 0 };
        matches!(reader.part(of), Some(ValueType::Number { .. }))
    };
    match (object(one), object(other)) {
        (Some(name), None) if is_number(other) => Some(name),
        (None, Some(name)) if is_number(one) => Some(name),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::misused;
    use behaviour::ValueType;

    fn found(body: &str) -> Option<(String, usize)> {
        let ball = ValueType::record([("x", ValueType::NUMBER), ("size", ValueType::NUMBER)]);
        let arguments =
            [("ball".to_owned(), ball), ("d".to_owned(), ValueType::NUMBER), ("any".to_owned(), ValueType::Any)];
        misused(&arguments, body, &|_, _| None)
    }

    #[test]
    fn an_object_is_no_number() {
        for body in ["ball < 0.5", "1 > ball", "ball * 2.0 + d", "if d < 1 { ball == 3 } else { false }", "d - ball"] {
            assert_eq!(found(body), Some(("ball".to_owned(), 1)), "{body}");
        }
        assert_eq!(found("ball > 1 && ball < 2"), Some(("ball".to_owned(), 2)));
    }

    #[test]
    fn doubt_speaks_for_it() {
        for body in [
            "ball.x < 0.5",
            "ball == ball",
            "ball + #{y: 1}",
            "any < 1",
            "ball < any",
            "let ball = 1; ball < 2",
            "`${ball}` + 1",
            "ball <",
            "fn f(ball) { ball < 1 } f(1)",
        ] {
            assert_eq!(found(body), None, "{body}");
        }
    }
}
