[
  (block)
  (monitor)
  (parallel)
  (fields)
  (cases)
  (parameters)
  (arguments)
  (list)
] @indent.begin

["}" ")" "]"] @indent.branch @indent.end
(comment) @indent.ignore
