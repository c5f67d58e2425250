-- Client of `motet lsp` inside Neovim; ends it with 0 if all is as expected.

local function finish(problem)
  if problem then
    io.stderr:write('nvim: ' .. problem .. '\n')
    vim.cmd('cquit')
  end
  io.stdout:write('nvim ' .. tostring(vim.version().major) .. '.' .. vim.version().minor .. ': all as expected\n')
  vim.cmd('qall!')
end

local function expect(condition, problem)
  if not condition then
    error(problem, 0)
  end
end

-- Waits until a value is there.
local function await(what, find)
  local value
  local is_there = vim.wait(20000, function()
    value = find()
    return value ~= nil and value ~= false
  end, 20)
  expect(is_there, what .. ' did not come')
  return value
end

local function test()
  vim.bo.filetype = 'motet'
  local id = vim.lsp.start_client({ name = 'motet', cmd = { vim.env.MOTET, 'lsp' }, root_dir = vim.fn.getcwd() })
  vim.lsp.buf_attach_client(0, id)
  local function request(method, line, column, extra)
    local params = vim.tbl_extend('force', {
      textDocument = vim.lsp.util.make_text_document_params(0),
      position = { line = line, character = column },
    }, extra or {})
    local answers = vim.lsp.buf_request_sync(0, method, params, 20000)
    expect(answers and answers[id] and not answers[id].err, method .. ' failed: ' .. vim.inspect(answers))
    return answers[id].result
  end

  local found = await('a diagnostic', function()
    return vim.diagnostic.get(0)[1]
  end)
  expect(found.code == 'M0501' and found.lnum == 2 and found.col == 4, vim.inspect(found))
  expect(found.source == 'motet' and found.severity == vim.diagnostic.severity.ERROR, vim.inspect(found))

  local hover = request('textDocument/hover', 2, 6).contents.value
  expect(hover:find('action handover', 1, true) and hover:find('Known here', 1, true), hover)

  vim.api.nvim_buf_set_lines(0, 2, 2, false, { '    pick(mug_1)', '    go(user)' })
  await('the end of the diagnostic', function()
    return #vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR }) == 0
  end)

  vim.api.nvim_buf_set_lines(0, 4, 4, false, { '    ' })
  local offered = {}
  for _, item in ipairs(request('textDocument/completion', 4, 4)) do
    offered[item.label] = true
  end
  expect(offered['handover'] and not offered['pick'], 'completion offers ' .. vim.inspect(vim.tbl_keys(offered)))

  local edits = request('textDocument/formatting', 0, 0, { options = { tabSize = 4, insertSpaces = true } })
  expect(edits ~= nil, 'no formatting')
  vim.lsp.stop_client(id)
end

local is_right, problem = pcall(test)
finish(not is_right and tostring(problem))
