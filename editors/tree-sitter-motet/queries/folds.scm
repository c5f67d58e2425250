[
  (block)
  (monitor)
  (parallel)
  (fields)
  (cases)
  (parameters)
  (arguments)
  (list)
] @fold
