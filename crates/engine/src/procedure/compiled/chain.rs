//! Chains such as `ball.speed.x`, `faces[0].label` and `x.abs()`.

use super::build::TreeBuilder;
use super::functions::Function;
use super::name::Name;
use super::node::ProcedureNode;
use rhai::{ASTFlags, BinaryExpr, Expr};

/// A link of a chain: what comes after a dot, or between brackets.
struct ChainLink<'e> {
    pair: &'e BinaryExpr,
    options: ASTFlags,
    dot: bool,
}

impl<'e> ChainLink<'e> {
    fn of(expression: &'e Expr) -> Option<Self> {
        match expression {
            Expr::Dot(pair, options, _) => Some(Self { pair, options: *options, dot: true }),
            Expr::Index(pair, options, _) => Some(Self { pair, options: *options, dot: false }),
            _ => None,
        }
    }

    /// Returns the content of this link, and the next link.
    fn split(&self) -> (&'e Expr, Option<Self>) {
        let ends = self.options.intersects(ASTFlags::BREAK);
        match Self::of(&self.pair.rhs).filter(|_| !ends) {
            Some(next) => (&next.pair.lhs, Some(next)),
            None => (&self.pair.rhs, None),
        }
    }
}

impl TreeBuilder<'_> {
    pub(super) fn chain(&mut self, expression: &Expr) -> Option<ProcedureNode> {
        let mut link = ChainLink::of(expression)?;
        let mut node = self.part(&link.pair.lhs)?;
        let mut links = 0;
        loop {
            links += 1;
            self.count_link(links)?;
            let (says, next) = link.split();
            node = self.linked(node, &link, says)?;
            link = match next {
                Some(next) => next,
                None => return Some(node),
            };
        }
    }

    fn linked(&mut self, of: ProcedureNode, link: &ChainLink, says: &Expr) -> Option<ProcedureNode> {
        if link.options.intersects(ASTFlags::NEGATED) {
            return None;
        }
        match says {
            Expr::Property(property, _) if link.dot => {
                let name = Name::of(property.2.as_str());
                Some(match of {
                    ProcedureNode::Input(at) => ProcedureNode::InputField(at, name),
                    of => ProcedureNode::Field(Box::new((of, name))),
                })
            }
            Expr::MethodCall(call, _) if link.dot => {
                let parameters = call.args.len() + 1;
                let taken = |many| self.helpers.has(&call.name, many);
                if taken(parameters) || taken(parameters - 1) {
                    return None;
                }
                let function = Function::of(&call.name, parameters)?;
                let arguments = std::iter::once(of).chain(self.parts(&call.args)?).collect();
                Some(ProcedureNode::Function(Box::new((function, arguments))))
            }
            _ if link.dot => None,
            at => Some(ProcedureNode::Item(Box::new((of, self.part(at)?)))),
        }
    }
}
