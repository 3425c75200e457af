-- A reader for pandoc: a public header of burnish becomes its page of the API reference. What it asks of a header stands in
-- CONTRIBUTING.md: a doc block right above each public item, `  name  text` per parameter, a comment beside each field.
-- Bodies of functions, and what stands between #if and #endif, are left out.

local folder = 'include/burnish/'
local statuses = {} -- the words of `Errors:` lines: ARGUMENT -> its link
local symbols = {}  -- every public name: name -> page#name
local fields = {}   -- "burnish_error.text": true
local lists = {}    -- X macros: name -> rows of arguments

local function escape(text)
  return (text:gsub('[&<>"]', { ['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;', ['"'] = '&quot;' }))
end

local function trim(text)
  return (text:gsub('^%s+', ''):gsub('%s+$', ''))
end

-- ---- From lines to items ----

-- The text of a comment, a line each, without what makes it one; indentation beyond one space stays.
local function comment_lines(lines)
  local text = {}
  for i, line in ipairs(lines) do
    line = line:gsub('%s*%*/%s*$', '')
    line = i == 1 and line:gsub('^%s*/%*', '') or line:gsub('^%s*%*', '')
    text[#text + 1] = (line:gsub('^ ', ''):gsub('%s+$', ''))
  end
  return text
end

-- The name that a declaration declares, and what it is.
local function name_of(declaration)
  local macro = declaration:match('^#define%s+([%w_]+)')
  if macro then
    return macro, 'macro'
  end
  local kind = declaration:match('^typedef%s+(%l+)')
  local named = declaration:match('}%s*([%w_]+)%s*;%s*$')
  if named then
    return named, kind
  end
  if declaration:match('^enum%s*{') then
    return declaration:match('{[^%w_]*([%w_]+)'), 'constants'
  end
  local called = declaration:match('([%w_]+)%s*%(')
  if called then
    return called, kind and 'function type' or 'function'
  end
  return declaration:match('([%w_]+)%s*;%s*$'), 'opaque type'
end

-- The items of a header in their order: {kind = section | text | entry, lines, declarations}.
local function items_of(text)
  local lines = {}
  for line in (text .. '\n'):gmatch('(.-)\n') do
    lines[#lines + 1] = line
  end
  local items, doc, entry = {}, nil, nil
  local depth, i = 0, 1
  local function loose() -- a comment that belongs to no declaration
    if doc then
      items[#items + 1] = { kind = 'text', lines = doc }
    end
    doc = nil
  end
  local function declare(declaration)
    if not entry then
      entry = { kind = 'entry', lines = doc or {}, declarations = {} }
      items[#items + 1] = entry
      doc = nil
    end
    entry.declarations[#entry.declarations + 1] = declaration
  end
  local function gather(ends)
    local all = { lines[i] }
    while not ends(all[#all], table.concat(all, '\n')) do
      i = i + 1
      all[#all + 1] = assert(lines[i], 'header.lua: a declaration without an end: ' .. all[1])
    end
    return all
  end
  while i <= #lines do
    local line = lines[i]
    if line:match('^#if') then
      if not line:match('_H$') then
        depth = depth + 1
        doc = nil
      end
    elseif line:match('^#endif') then
      depth = math.max(0, depth - 1)
    elseif depth > 0 or line:match('^#define%s+[%w_]+_H$') or line:match('^#[^d]') then
      depth = depth -- left out
    elseif line:match('^%s*$') then
      loose()
      entry = nil
    elseif line:match('^/%*') then
      local comment = comment_lines(gather(function(last) return last:match('%*/') end))
      entry = nil
      local title = comment[1]:match('^%-%-%-%- (.-) %-%-%-')
      if title then
        table.remove(comment, 1)
        items[#items + 1] = { kind = 'section', title = title, lines = comment }
      else
        loose()
        doc = comment
      end
    elseif line:match('^#define') then
      declare(table.concat(gather(function(last) return not last:match('\\$') end), '\n'))
    elseif line:match('^static inline') or line:match('^BURNISH_[%u%d_]*INLINE') then
      local signature = table.concat(gather(function(last) return last:match('{') end), ' ')
      declare((signature:gsub('%s*{.*$', ';')))
      if not lines[i]:match('}%s*$') then
        gather(function(last) return last:match('^}') end)
      end
    elseif line:match('^[%a]') and not line:match('^extern') then
      declare(table.concat(gather(function(_, all)
        local _, opened = all:gsub('{', '')
        local _, closed = all:gsub('}', '')
        return opened == closed and all:gsub('/%*.-%*/', ''):match(';%s*$')
      end), '\n'))
    end
    i = i + 1
  end
  return items
end

-- Members of a struct or an enum: {text of the declaration, its comment's lines}.
local function members_of(declaration)
  local body = declaration:match('{(.*)}')
  local ends = (declaration:match('^typedef%s+enum') or declaration:match('^enum')) and ',' or ';'
  local members, above, at = {}, nil, 1
  local function add(text)
    text = trim(text:gsub('%s+', ' '))
    if text ~= '' then
      members[#members + 1] = { text = text, lines = above }
      above = nil
    end
  end
  -- X macros: the rows of the list that the enum expands
  local prefix = body:match('#define [%w_]+%([^)]*%) ([%w_]-)##name')
  local list = body:match('\n%s*([%w_]+_LIST)%(')
  body = body:gsub('#define[^\n]*\n', ''):gsub('#undef[^\n]*\n', '')
  if prefix and list then
    for _, row in ipairs(lists[list] or {}) do
      local text = row[#row]:match('^"(.*)"$')
      members[#members + 1] = { text = prefix .. row[1], lines = text and { text } }
    end
    body = body:gsub('%s*' .. list .. '%([%w_]+%)', '', 1)
  end
  while at <= #body do
    local from, to = body:find('/%*.-%*/', at)
    local stop = body:find(ends, at, true)
    if from and (not stop or from < stop) then
      local comment = {}
      for line in body:sub(from, to):gmatch('[^\n]+') do
        comment[#comment + 1] = line
      end
      comment = comment_lines(comment)
      for n = 1, #comment do
        comment[n] = trim(comment[n])
      end
      local before = body:sub(at, from - 1)
      if before:match('%S') then -- the last of an enum has no comma
        add(before)
        members[#members].lines = comment
      elseif not before:find('\n') and #members > 0 then
        members[#members].lines = comment
      else
        above = comment
      end
      at = to + 1
    else
      add(body:sub(at, (stop or #body + 1) - 1))
      at = (stop or #body) + 1
    end
  end
  return members
end

local function member_name(text)
  return text:match('%(%*([%w_]+)%)') or text:gsub('%[.*', ''):gsub('%s*=.*', ''):match('([%w_]+)%s*$')
end

-- Rows of an X macro: X(OK, 0, "success") ...
local function rows_of(declaration)
  local rows = {}
  for arguments in declaration:gsub('\\\n', ' '):gsub('^#define%s+[%w_]+%(X%)', ''):gmatch('X(%b())') do
    local row, quoted, cell = {}, false, ''
    for character in arguments:sub(2, -2):gmatch('.') do
      quoted = quoted ~= (character == '"')
      if character == ',' and not quoted then
        row[#row + 1] = trim(cell)
        cell = ''
      else
        cell = cell .. character
      end
    end
    row[#row + 1] = trim(cell):gsub('"%s+"', '')
    rows[#rows + 1] = row
  end
  return rows
end

-- ---- From text to blocks ----

local function identifier(word)
  if symbols[word] then
    return pandoc.Link({ pandoc.Code(word) }, symbols[word])
  elseif word:match('_') or word:match('^burnish%w') then
    return pandoc.Code(word)
  end
end

-- Prose as inlines: names become links, words with an underscore code, `quoted` code.
local function inlines(text, errors)
  local result = pandoc.List()
  local plain = ''
  local function flush()
    for space, word in plain:gmatch('(%s*)(%S*)') do
      if space ~= '' then
        result:insert(pandoc.Space())
      end
      if word ~= '' then
        result:insert(pandoc.Str(word))
      end
    end
    plain = ''
  end
  local function put(inline)
    flush()
    result:insert(inline)
  end
  local at = 1
  while at <= #text do
    local header = text:match('^burnish/([%w_]+)%.h', at) or text:match('^([%w_]+)%.h', at)
    local quoted = text:match('^`([^`]+)`', at)
    local other = text:match('^docs/([%w_]+)%.md', at)
    local word = text:match('^[%a_][%w_]*', at)
    if quoted then
      put(pandoc.Code(quoted))
      at = at + #quoted + 2
    elseif other then
      put(pandoc.Link({ pandoc.Str('docs/' .. other .. '.md') }, '../' .. other .. '.html'))
      at = at + #other + 8
    elseif header and symbols[header .. '.h'] then
      local shown = text:match('^[%w_/]+%.h', at)
      put(pandoc.Link({ pandoc.Code(shown) }, symbols[header .. '.h']))
      at = at + #shown
    elseif word then
      local called = text:match('^[%a_][%w_]*%(%)', at)
      local inline = identifier(word)
      local field = symbols[word] and text:match('^[%w_]+%.[%a_][%w_]*', at)
      if field and fields[field] then
        called = field
        inline = pandoc.Link({ pandoc.Code(field) }, symbols[word] .. field:sub(#word + 1))
      end
      if errors and statuses[word] then
        inline = pandoc.Link({ pandoc.Code(word) }, statuses[word])
      end
      if inline then
        put(inline)
      else
        plain = plain .. word
      end
      at = at + #(inline and called or word)
    else
      plain = plain .. text:sub(at, at)
      at = at + 1
    end
  end
  flush()
  return result
end

local function paragraph(text)
  if text:match('^Errors:') then
    return pandoc.Div({ pandoc.Para(inlines(text, true)) }, pandoc.Attr('', { 'errors' }))
  end
  local title, rest = text:match('^(What it [%l ]+[.:])(.*)')
  if not title then
    title, rest = text:match('^(How to use it%.)(.*)')
  end
  if title then
    local words = pandoc.List({ pandoc.Strong(inlines(title)) })
    words:extend(inlines(rest))
    return pandoc.Para(words)
  end
  return pandoc.Para(inlines(text))
end

local blocks -- of lines

-- The lines after `at` that are indented further than `indent`, blank ones between them included.
local function indented(lines, at, indent)
  local last = at
  for n = at + 1, #lines do
    local spaces = #lines[n]:match('^ *')
    if lines[n] ~= '' then
      if spaces <= indent then
        break
      end
      last = n
    end
  end
  return last
end

local function definition(name, lines)
  return { { pandoc.Code(name) }, { blocks(lines) } }
end

blocks = function(lines)
  local result = pandoc.List()
  local text, at = {}, 1
  local function flush()
    if #text > 0 then
      -- the formatter of the sources joins lines; these words begin a paragraph
      local all = table.concat(text, ' '):gsub('([%.%)]) (Errors: )', '%1\n%2'):gsub('([%.%)]) (Sources?[:.] )', '%1\n%2')
      for part in all:gmatch('[^\n]+') do
        result:insert(paragraph(part))
      end
    end
    text = {}
  end
  while at <= #lines do
    local line = lines[at]
    local indent = #line:match('^ *')
    local number, mark = line:match('^ *(%d+)%. '), line:match('^ *(%-) ')
    local name, rest = line:match('^  ([%a_][%w_, %-]-)  +(%S.*)$')
    if rest and rest:match('%S   +%S') then
      name = nil -- a table
    end
    local last = indented(lines, at, indent)
    if line == '' then
      flush()
    elseif number or mark then
      flush()
      local inner = { (line:gsub(number and '^ *%d+%. ' or '^ *%- ', '')) }
      local continued = indent + (number and #number + 2 or 2)
      for n = at + 1, last do
        inner[#inner + 1] = lines[n]:sub(continued + 1)
      end
      local previous, content = result[#result], blocks(inner)
      if previous and previous.t == (number and 'OrderedList' or 'BulletList') then
        previous.content:insert(content)
      else
        result:insert(number and pandoc.OrderedList({ content }) or pandoc.BulletList({ content }))
      end
      at = last
    elseif name and indent == 2 then
      flush()
      local inner = { rest }
      for n = at + 1, last do
        inner[#inner + 1] = trim(lines[n])
      end
      local previous = result[#result]
      if previous and previous.t == 'DefinitionList' then
        previous.content:insert(definition(name, inner))
      else
        result:insert(pandoc.DefinitionList({ definition(name, inner) }))
      end
      at = last
    elseif indent >= 2 then
      flush()
      last = indented(lines, at, 1)
      local code = {}
      for n = at, last do
        indent = lines[n] == '' and indent or math.min(indent, #lines[n]:match('^ *'))
      end
      for n = at, last do
        code[#code + 1] = lines[n]:sub(indent + 1)
      end
      local shown = table.concat(code, '\n')
      result:insert(pandoc.CodeBlock(shown, pandoc.Attr('', shown:match('[;{]%s*\n') and { 'c' } or {})))
      at = last
    else
      if line:match('^Errors:') or line:match('^Returns ') or line:match('^Sources?[:.]') then
        flush()
      end
      text[#text + 1] = line
    end
    at = at + 1
  end
  flush()
  return result
end

-- ---- From items to pages ----

local keywords = {}
for word in ('const void int char float double size_t uint8_t uint16_t uint32_t uint64_t int16_t int32_t uint_fast16_t struct enum typedef unsigned define'):gmatch('%S+') do
  keywords[word] = true
end

-- C as HTML: names of types are links, what is declared stands out.
local function code_html(text, own)
  return (escape(text):gsub('[%a_][%w_]*', function(word)
    if word == own then
      return '<b>' .. word .. '</b>'
    elseif keywords[word] then
      return '<span class="kw">' .. word .. '</span>'
    elseif symbols[word] then
      return '<a href="' .. symbols[word] .. '">' .. word .. '</a>'
    end
  end))
end

-- A function's signature without what only compilers read; one parameter a line where it is long.
local function signature(declaration)
  local text = declaration:gsub('BURNISH_API ', ''):gsub('static inline ', ''):gsub('BURNISH_[%u%d_]*INLINE ', ''):gsub('%s+', ' ')
  text = text:gsub('%( ', '(')
  if #text > 76 and text:match('%(') then
    local head, parameters = text:match('^(.-%()(.*)%);$')
    text = head .. '\n    ' .. parameters:gsub(', ', ',\n    ') .. ');'
  end
  return text
end

-- The members of a struct or an enum; those without a comment of their own take what the doc block says of their name.
local function members_list(declaration, doc)
  local list = {}
  local fields_of = declaration:match('^typedef struct') and name_of(declaration) .. '.' or ''
  for _, member in ipairs(members_of(declaration)) do
    local name = member_name(member.text)
    local term = '<code id="' .. fields_of .. name .. '">' .. code_html(member.text, name) .. '</code>'
    list[#list + 1] = { { pandoc.RawInline('html', term) }, { member.lines and blocks(member.lines) or doc[name] or {} } }
    doc[name] = nil
  end
  local kind = fields_of ~= '' and 'fields' or 'constants'
  return pandoc.Div({ pandoc.DefinitionList(list) }, pandoc.Attr('', { 'members', kind }))
end

-- Takes from a doc block's blocks what it says of names that members have.
local function take_definitions(doc, declaration)
  local members, taken, rest = {}, {}, pandoc.List()
  for _, member in ipairs(members_of(declaration)) do
    members[member_name(member.text)] = not member.lines
  end
  for _, block in ipairs(doc) do
    local all = block.t == 'DefinitionList'
    for _, item in ipairs(all and block.content or {}) do
      all = all and members[pandoc.utils.stringify(item[1])]
    end
    for _, item in ipairs(all and block.content or {}) do
      taken[pandoc.utils.stringify(item[1])] = item[2][1]
    end
    if not all then
      rest:insert(block)
    end
  end
  return rest, taken
end

-- The rows of an X macro as a table, whose heading is what the doc block says of X(...).
local function rows_table(declaration, doc)
  local rows = rows_of(declaration)
  local heading = {}
  for word in (table.concat(doc, ' '):match('X%((.-)%)') or ''):gmatch('[^,]+') do
    heading[#heading + 1] = { pandoc.Plain(inlines(trim(word))) }
  end
  local cells = {}
  for _, row in ipairs(rows) do
    local line = {}
    for n = 1, #rows[1] do
      local text = (row[n] or ''):match('^"(.*)"$')
      line[n] = { pandoc.Plain(text and inlines(text) or row[n] and row[n]:match('%a') and { pandoc.Code(row[n]) } or inlines(row[n] or '')) }
    end
    cells[#cells + 1] = line
    heading[#line] = heading[#line] or { pandoc.Plain({}) }
  end
  local aligns, widths = {}, {}
  for n = 1, #rows[1] do
    aligns[n], widths[n] = 'AlignDefault', 0
    heading[n] = heading[n] or { pandoc.Plain({}) }
  end
  return pandoc.utils.from_simple_table(pandoc.SimpleTable({}, aligns, widths, heading, cells))
end

-- What the names of members have in common, whole words of it: "BURNISH_EDGES_".
local function common_start(members)
  local start = member_name(members[1].text)
  for _, member in ipairs(members) do
    while member_name(member.text):sub(1, #start) ~= start do
      start = start:sub(1, -2)
    end
  end
  return start:match('^(.*_)') or start
end

local function entry_blocks(item)
  local result = pandoc.List()
  local name, kind = name_of(item.declarations[1])
  local title = name
  if kind == 'constants' then -- an enum without a name is known by what its constants' names begin with
    name = common_start(members_of(item.declarations[1]))
    title = name .. '…'
  end
  result:insert(pandoc.Header(3, { pandoc.Code(title) }, pandoc.Attr(name, { 'item' }, { { 'kind', kind } })))
  local shown, after, doc = {}, pandoc.List(), blocks(item.lines)
  for _, declaration in ipairs(item.declarations) do
    local own, what = name_of(declaration)
    local anchor = own ~= title and '<span id="' .. own .. '"></span>' or ''
    if lists[own] then
      after:insert(rows_table(declaration, item.lines))
    elseif what == 'struct' or what == 'enum' or what == 'constants' then
      local rest, taken = take_definitions(doc, declaration)
      doc = rest
      after:insert(members_list(declaration, taken))
    else
      local text = what == 'macro' and trim(declaration:gsub('\\\n', ' '):gsub('%s+', ' ')) or signature(declaration)
      shown[#shown + 1] = anchor .. code_html(text, own)
    end
  end
  if #shown > 0 then
    result:insert(pandoc.RawBlock('html', '<pre class="signature"><code>' .. table.concat(shown, '\n') .. '</code></pre>'))
  end
  result:extend(doc)
  result:extend(after)
  return result
end

-- What is private to a header: macros that spell attributes, and what it takes from one that it includes.
local function is_public(item)
  local name = name_of(item.declarations[1])
  return not (name:match('_INLINE$') or name == 'BURNISH_API' or name == 'BURNISH_Q15_AVR')
end

local function read_header(name)
  local file = assert(io.open(folder .. name .. '.h'))
  local text = file:read('a')
  file:close()
  return items_of(text)
end

-- Every public name, so that each can be linked from everywhere.
local function learn_symbols(names)
  local headers = {}
  for _, name in ipairs(names) do
    local page = name .. '.html'
    headers[name] = read_header(name)
    symbols[name .. '.h'] = page
    for _, item in ipairs(headers[name]) do
      for _, declaration in ipairs(item.kind == 'entry' and is_public(item) and item.declarations or {}) do
        local own, kind = name_of(declaration)
        symbols[own] = page .. '#' .. own
        if own:match('_LIST$') then
          lists[own] = rows_of(declaration)
        end
        if kind == 'struct' then
          for _, member in ipairs(members_of(declaration)) do
            fields[own .. '.' .. member_name(member.text)] = true
          end
        end
        if kind == 'enum' or kind == 'constants' then
          for _, member in ipairs(members_of(declaration)) do
            local constant = member_name(member.text)
            symbols[constant] = symbols[constant] or page .. '#' .. constant
          end
        end
      end
    end
  end
  for _, row in ipairs(lists.BURNISH_STATUS_LIST) do
    statuses[row[1]] = 'core.html#BURNISH_STATUS_' .. row[1]
  end
  for _, row in ipairs(lists.BURNISH_LOBE_STATUS_LIST) do
    statuses[row[1]] = statuses[row[1]] or 'lobe.html#BURNISH_LOBE_' .. row[1]
  end
  return headers
end

function Reader(input)
  local names, own = {}, nil
  for name in os.getenv('BURNISH_HEADERS'):gmatch('[%w_]+') do
    names[#names + 1] = name
  end
  own = os.getenv('BURNISH_HEADER')
  local items = learn_symbols(names)[own]
  assert(#tostring(input) > 0)
  local result = pandoc.List({ pandoc.Header(1, { pandoc.Code('burnish/' .. own .. '.h') }) })
  for n, item in ipairs(items) do
    if item.kind == 'section' then
      local id = item.title:lower():gsub('[^%w]+', '-')
      result:insert(pandoc.Header(2, inlines(item.title), pandoc.Attr(id)))
      result:extend(blocks(item.lines))
    elseif item.kind == 'text' then
      local lines = {}
      for _, line in ipairs(item.lines) do
        if not line:match('^SPDX') and not line:match('^Copyright') then
          lines[#lines + 1] = line
        end
      end
      if n == 1 then
        lines[1] = lines[1]:gsub('^burnish/[%w_]+%.h: ', ''):gsub('^%l', string.upper)
      end
      result:extend(blocks(lines))
    elseif is_public(item) then
      result:extend(entry_blocks(item))
    end
  end
  return pandoc.Pandoc(result)
end
