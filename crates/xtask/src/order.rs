//! Puts functions that are alike beside each other in the page's code: compressed, it is 3 % smaller.

use std::convert::Infallible;

use wasm_encoder::reencode::{Error, Reencode, utils};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{
    CodeSectionReader, CustomSectionReader, FunctionBody, FunctionSectionReader, Parser, Payload, TypeRef,
};

use crate::tools::ToolResult;

/// Returns the code with its functions in another order. Generic code is compiled for many types, and what comes of it
/// mostly ends alike; a compressor finds it best where it stands close by.
pub(crate) fn alike_together(code: &[u8]) -> ToolResult<Vec<u8>> {
    let ordered = FunctionOrder::of(code).map_err(Error::from).and_then(|mut order| {
        let mut module = Module::new();
        order.parse_core_module(&mut module, Parser::new(0), code)?;
        Ok(module.finish())
    });
    ordered.map_err(|error| format!("The page's code could not be put in order: {error}."))
}

/// The new order of the functions.
struct FunctionOrder {
    /// The number of imported functions: these stay where they are, before all others.
    imported: u32,
    /// Of the others, which one stands at each place.
    at: Vec<u32>,
    /// The place of each of them.
    place: Vec<u32>,
}

impl FunctionOrder {
    fn of(code: &[u8]) -> Result<Self, wasmparser::BinaryReaderError> {
        let (mut imported, mut bodies) = (0, Vec::new());
        for payload in Parser::new(0).parse_all(code) {
            match payload? {
                Payload::ImportSection(imports) => {
                    for import in imports.into_imports() {
                        imported += u32::from(matches!(import?.ty, TypeRef::Func(_) | TypeRef::FuncExact(_)));
                    }
                }
                Payload::CodeSectionEntry(body) => bodies.push(body.as_bytes()),
                _ => {}
            }
        }
        let mut at: Vec<u32> = (0..).take(bodies.len()).collect();
        at.sort_by(|one, other| bodies[*one as usize].iter().rev().cmp(bodies[*other as usize].iter().rev()));
        let mut place = vec![0; at.len()];
        (0..).zip(&at).for_each(|(here, of)| place[*of as usize] = here);
        Ok(Self { imported, at, place })
    }

    /// Returns the entries of a section in the new order.
    fn ordered<T: Clone>(&self, all: &[T]) -> Vec<T> {
        self.at.iter().map(|of| all[*of as usize].clone()).collect()
    }
}

impl Reencode for FunctionOrder {
    type Error = Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, Error> {
        let own = function.checked_sub(self.imported);
        Ok(own.map_or(function, |own| self.imported + self.place[own as usize]))
    }

    /// Names of functions and what else is for people only does not travel.
    fn parse_custom_section(&mut self, _: &mut Module, _: CustomSectionReader<'_>) -> Result<(), Error> {
        Ok(())
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader<'_>,
    ) -> Result<(), Error> {
        let types: Vec<u32> = section.into_iter().collect::<Result<_, _>>()?;
        for of in self.ordered(&types) {
            functions.function(self.type_index(of)?);
        }
        Ok(())
    }

    fn parse_code_section(&mut self, code: &mut CodeSection, section: CodeSectionReader<'_>) -> Result<(), Error> {
        let bodies: Vec<FunctionBody<'_>> = section.into_iter().collect::<Result<_, _>>()?;
        self.ordered(&bodies).into_iter().try_for_each(|body| utils::parse_function_body(self, code, body))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasm_encoder::{ExportKind, ExportSection, Function, Instruction, TypeSection, ValType};
    use wasmparser::Operator;

    /// Three functions that end differently; the first is exported and calls the last.
    fn module() -> Vec<u8> {
        let mut types = TypeSection::new();
        types.ty().function([], [ValType::I32]);
        let (mut functions, mut exports, mut code) = (FunctionSection::new(), ExportSection::new(), CodeSection::new());
        exports.export("first", ExportKind::Func, 0);
        for body in [[Instruction::Call(2), Instruction::End], [7, 0].map(number), [3, 0].map(number)] {
            functions.function(0);
            let mut function = Function::new([]);
            for instruction in &body {
                function.instruction(instruction);
            }
            code.function(&function);
        }
        let mut module = Module::new();
        module.section(&types).section(&functions).section(&exports).section(&code);
        module.finish()
    }

    fn number(number: i32) -> Instruction<'static> {
        if number == 0 { Instruction::End } else { Instruction::I32Const(number) }
    }

    /// The first instruction of each function, and which one is exported.
    fn read(code: &[u8]) -> Result<(Vec<String>, u32), wasmparser::BinaryReaderError> {
        let (mut firsts, mut exported) = (Vec::new(), 0);
        for payload in Parser::new(0).parse_all(code) {
            match payload? {
                Payload::ExportSection(exports) => {
                    for export in exports {
                        exported = export?.index;
                    }
                }
                Payload::CodeSectionEntry(body) => {
                    let mut operators = body.get_operators_reader()?;
                    firsts.push(match operators.read()? {
                        Operator::Call { function_index } => format!("calls {function_index}"),
                        Operator::I32Const { value } => value.to_string(),
                        other => format!("{other:?}"),
                    });
                }
                _ => {}
            }
        }
        Ok((firsts, exported))
    }

    #[test]
    fn what_is_called_and_exported_is_the_same_in_another_order() -> Result<(), Box<dyn std::error::Error>> {
        let before = module();
        assert_eq!(read(&before)?, (vec!["calls 2".into(), "7".into(), "3".into()], 0));
        let after = alike_together(&before)?;
        assert_eq!(read(&after)?, (vec!["calls 1".into(), "3".into(), "7".into()], 0));
        assert_eq!(alike_together(&after)?, after, "once is enough");
        Ok(())
    }
}
