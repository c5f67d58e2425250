; Of several patterns that match, the last one counts.

(identifier) @variable
(quoted_name) @variable

(comment) @comment
(doc) @comment.documentation

[
  "kind" "fluent" "measure" "failure" "enum" "entity" "initially" "closed" "world" "action" "perception" "policy"
] @keyword

[
  "needs" "makes" "unsettles" "motion" "uses" "takes" "fails" "lasts" "achieves" "keep" "out" "of" "for" "as" "in"
  "at" "most" "within" "retry" "slowly" "gently"
] @keyword.modifier

[
  "let" "sequence" "wait" "until" "monitor" "when" "then" "during" "parallel" "pause" "restart" "resume" "finally"
] @keyword

["if" "else"] @keyword.conditional
["repeat" "each"] @keyword.repeat
["try" "catch"] @keyword.exception
["done" "fail" "cannot" "replan"] @keyword.return
["and" "or" "not"] @keyword.operator
"any" @constant.builtin
(boolean) @boolean
"List" @type.builtin

(policy name: (_) @function)
(action name: (_) @function)
(perception name: (_) @function)
(fluent name: (_) @function.method)
(measure name: (_) @function.method)
(kind name: (_) @type parent: (_)? @type)
(enumeration name: (_) @type)
(failure name: (_) @constant)
(cases (_) @constant)
(entities name: (_) @constant kind: (_) @type)
(for_robot robot: (_) @module)
(sequence name: (_) @label)
(type) @type
(parameter name: (_) @variable.parameter)
(argument name: (_) @variable.parameter)
(let_step name: (_) @variable)
(each name: (_) @variable)
(catch name: (_) @variable)
(quantified name: (_) @variable)
(field name: (_) @property)
(binding) @variable

(call function: (_) @function.method.call)
(call_step (call function: (_) @function.call))

(number) @number
(unit) @number
(text) @string
(escape) @string.escape
(interpolation ["{" "}"] @punctuation.special)
(operator) @operator
["->" "=" ".."] @operator
["{" "}" "(" ")" "[" "]"] @punctuation.bracket
["," ":" "."] @punctuation.delimiter
