"""Fine-tuning of language models on rows of `motet dataset`.

`recipe` reads a recipe, `rows` the rows, `train` trains adapters, `merge` puts them into the weights, `export` writes GGUF,
`serve` answers `motet do --planner`, and `judge` has a model answer held-out rows and counts the policies that can run.
"""
