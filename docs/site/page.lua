-- A pandoc filter for every page: rewrites links and images to the site's paths, adds anchors, contents and navigation, makes
-- tables scroll, and writes the page's part of the search index.
-- Environment: SITE_PATH, the page's file in the repository; SITE_WORK, a folder with `pages` (lines of "file page"), to which
-- this filter adds `files` (images and sources to copy) and `index/`; SITE_EXPLORER, the explorer's start page.

local utils = pandoc.utils
local source = os.getenv('SITE_PATH')
local work = os.getenv('SITE_WORK')

-- ---- Paths ----

local pages = {} -- file of the repository -> page of the site
for line in io.lines(work .. '/pages') do
  local file, page = line:match('^(%S+) (%S+)$')
  pages[file] = page
end
local page = pages[source] or 'source/' .. source .. '.html'
local root = page:gsub('[^/]+', '..'):gsub('%.%.$', '')

-- "docs", "../bindings/npm/README.md" -> "bindings/npm/README.md"
local function join(folder, path)
  local parts = {}
  for part in (folder .. '/' .. path):gmatch('[^/]+') do
    if part == '..' then
      table.remove(parts)
    elseif part ~= '.' then
      parts[#parts + 1] = part
    end
  end
  return table.concat(parts, '/')
end

local function exists(path)
  local file = io.open(path)
  return file and file:close()
end

local files = {}
-- The site's address of a repository file. Images are copied; source files become pages.
local function address(file)
  if pages[file] then
    return root .. pages[file]
  end
  if not exists(file) then
    error(source .. ': broken link to ' .. file)
  end
  local picture = file:match('%.svg$') or file:match('%.png$') or file:match('%.gif$') or file:match('%.jpe?g$')
  local copy = picture and file:gsub('^docs/', '') or 'source/' .. file .. '.html'
  files[#files + 1] = (picture and 'picture ' or 'source ') .. file .. ' ' .. copy
  return root .. copy
end

local function site_link(target)
  if source:match('^include/') or target:match('^%a+:') or target:match('^#') then
    return target
  end
  local path, anchor = target:match('^([^#]*)(.*)$')
  return address(join(source:match('^(.*)/') or '', path)) .. anchor
end

-- ---- Images ----

-- Width and height of a PNG or JPEG, which keep the layout stable while it loads.
local function picture_size(path)
  local file = io.open(path, 'rb')
  local bytes = file and file:read('a') or ''
  if file then
    file:close()
  end
  if bytes:sub(1, 4) == '\137PNG' then
    return string.unpack('>I4I4', bytes, 17)
  elseif bytes:sub(1, 2) == '\255\216' then
    local at = 3
    while at + 9 < #bytes do
      local _, marker, length, _, height, width = string.unpack('>BBI2BI2I2', bytes, at)
      if marker >= 0xC0 and marker <= 0xC3 then
        return width, height
      end
      at = at + 2 + length
    end
  end
end

local function show(image)
  local path = join(source:match('^(.*)/') or '', image.src)
  local width, height = picture_size(path)
  image.src = address(path)
  if width then
    image.attributes.width, image.attributes.height = tostring(width), tostring(height)
    image.attributes.loading = 'lazy'
  end
  if path:match('/figures/') or path:match('%.svg$') then
    image.classes:insert('figure')
  end
  return image
end

local function scrolling(block)
  return pandoc.Div({ block }, pandoc.Attr('', { 'table' }, { { 'tabindex', '0' } }))
end

local function image_of(cell)
  return cell and #cell == 1 and #cell[1].content == 1 and cell[1].content[1].t == 'Image' and cell[1].content[1]
end

-- Turns a table of images, with labels in its first column, into tiles with captions. The images can also be the headings of one row.
local function picture_table(simple)
  local figures = pandoc.List()
  if #simple.rows == 1 and image_of(simple.headers[1]) then
    simple.headers, simple.rows = simple.rows[1], pandoc.List({ simple.headers })
  end
  for _, row in ipairs(simple.rows) do
    local label = ''
    for column, cell in ipairs(row) do
      local image = image_of(cell)
      local heading = utils.stringify(simple.headers[column] or {})
      if image then
        local caption = label == '' and heading or label .. ': ' .. heading
        local code = simple.headers[column]
        image.caption = #image.caption > 0 and image.caption or { pandoc.Str(caption) }
        local words = label == '' and code[1] and code[1].content or { pandoc.Str(caption) }
        figures:insert(pandoc.Div({
          pandoc.Plain({ pandoc.Link({ image }, image.src) }),
          pandoc.Div({ pandoc.Plain(words) }, pandoc.Attr('', { 'caption' })),
        }, pandoc.Attr('', { 'tile' })))
      elseif column == 1 then
        label = utils.stringify(cell)
      else
        return nil
      end
    end
  end
  local columns = #figures // #simple.rows
  return #figures > 0 and pandoc.Div(figures, pandoc.Attr('', { 'tiles', 'of-' .. columns }))
end

-- ---- Contents, navigation, search ----

local function json(text)
  return '"' .. text:gsub('[%c"\\<]', function(c) return string.format('\\u%04x', c:byte()) end) .. '"'
end

local function escape(text)
  return (text:gsub('[&<>]', { ['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;' }))
end

-- A heading as HTML. pandoc's writer would take longer than the rest of the page.
local function words_of(inlines)
  local out = {}
  for _, inline in ipairs(inlines) do
    local text = escape(utils.stringify(inline))
    out[#out + 1] = inline.t == 'Code' and '<code>' .. text .. '</code>' or text
  end
  return table.concat(out)
end

-- Navigation from the headings of docs/README.md and the first link of each line, and this page's name there.
local function navigation()
  local out, open, name = {}, false, nil
  for line in io.lines('docs/README.md') do
    local heading = line:match('^## (.*)')
    local words, link = line:match('^%- %[(.-)%]%((.-)%)')
    if line:match('^%- `burnish%(1%)`') then
      words, link = 'burnish(1)', 'burnish.1'
    end
    if heading then
      out[#out + 1] = (open and '</ul>\n<h2>' or '<h2>') .. escape(heading) .. '</h2>\n<ul>'
      open = true
    elseif words then
      local target = pages[join('docs', link)]
      if not target then
        error('docs/README.md: ' .. link .. ' is not a page of the site')
      end
      name = target == page and words or name
      local here = target == page and ' aria-current="page"' or ''
      out[#out + 1] = '<li><a href="' .. root .. target .. '"' .. here .. '>' .. escape(words) .. '</a></li>'
    end
  end
  return table.concat(out, '\n') .. '\n</ul>', name
end

local function contents(headings)
  local out = {}
  for _, heading in ipairs(headings) do
    local words = words_of(heading.content)
    words = heading.content[1].t == 'Code' and words:gsub('_', '_<wbr>') or words
    out[#out + 1] = '<li class="level-' .. heading.level .. '"><a href="#' .. heading.identifier .. '">' .. words .. '</a></li>'
  end
  return #headings > 1 and '<ul>' .. table.concat(out, '\n') .. '</ul>' or nil
end

-- One entry per heading: title, address, kind, the page's name, text.
local function index(blocks, title, name)
  local entries, current = {}, nil
  local function begin(words, anchor, kind)
    current = { words, anchor, kind, {} }
    entries[#entries + 1] = current
  end
  begin(title, '', '')
  for _, block in ipairs(blocks) do
    local flags = block.t == 'DefinitionList' and source:match('%.1$') and block.content or {}
    for _, item in ipairs(flags) do
      local id = item[1][1] and item[1][1].identifier or ''
      if id ~= '' then
        begin(utils.stringify(item[1]), '#' .. id, id:match('^(.-)%-%-'):gsub('-', ' '))
        table.insert(current[4], utils.stringify(pandoc.Div(item[2][1])))
      end
    end
    if block.t == 'Header' then
      begin(utils.stringify(block), '#' .. block.identifier, block.attributes.kind or '')
    elseif block.t == 'RawBlock' then
      table.insert(current[4], (block.text:gsub('<[^>]*>', '')))
    elseif #flags == 0 then
      -- stringify joins cells and list items without a space
      local spaced = pandoc.walk_block(pandoc.Div({ block }), {
        Plain = function(x) x.content:insert(pandoc.Space()) return x end,
        Para = function(x) x.content:insert(pandoc.Space()) return x end,
        RawBlock = function(x) return pandoc.Para({ pandoc.Str((x.text:gsub('<[^>]*>', '') .. ' ')) }) end,
        Math = function(x) return pandoc.Str((x.text:gsub('\\%a+', ' '):gsub('[{}\\]', ''))) end,
        CodeBlock = function(x) return pandoc.Para({ pandoc.Str(x.text .. ' ') }) end,
      })
      table.insert(current[4], utils.stringify(spaced))
    end
  end
  local file = assert(io.open(work .. '/index/' .. page:gsub('/', '_'), 'w'))
  for _, entry in ipairs(entries) do
    local text = table.concat(entry[4], ' '):gsub('%s+', ' ')
    file:write('[', json(entry[1]), ',', json(page .. entry[2]), ',', json(entry[3]), ',', json(name), ',', json(text), '],\n')
  end
  file:close()
end

-- ---- The manual page ----

local command = ''
-- Headings like other pages', and an anchor for every flag: "render--output".
local function manual_block(block)
  if block.t == 'Header' then
    block.level = block.level + 1
    local words = utils.stringify(block)
    if words == words:upper() then
      words = words:sub(1, 1) .. words:sub(2):lower()
      command = words:lower():gsub(' ', '-')
    end
    block.content = { pandoc.Str(words) }
  elseif block.t == 'DefinitionList' then
    for _, item in ipairs(block.content) do
      local words = utils.stringify(item[1])
      local flag = words:match('^%-') and words:match('%-%-[%w-]+')
      if flag then
        item[1] = { pandoc.Span(item[1], pandoc.Attr(command .. flag)) }
      end
    end
  end
  return block
end

-- ---- The page ----

function Pandoc(document)
  local title, headings = nil, pandoc.List()
  local kept = pandoc.List()
  for _, block in ipairs(document.blocks) do
    if block.t == 'Header' and block.level == 1 and not title then
      title = block
    else
      kept:insert(block)
    end
  end
  if source:match('%.1$') then -- all headings of a manual page are of level 1, and none is the title
    title, headings, kept = pandoc.Header(1, { pandoc.Str('burnish(1)') }), pandoc.List(), pandoc.List()
    for _, block in ipairs(document.blocks) do
      kept:insert(manual_block(block))
    end
  end
  assert(title, source .. ': no heading of level 1')
  local words = utils.stringify(title)
  local links, name = navigation()
  if not source:match('%.html$') and pages[source] then
    index(kept, words, name or words)
  end
  local body = pandoc.walk_block(pandoc.Div(kept), {
    Link = function(link)
      link.target = site_link(link.target)
      return link
    end,
    Image = show,
    Code = function(code)
      if code.text == 'burnish(1)' and page ~= pages['docs/burnish.1'] then
        return pandoc.Link({ code }, root .. pages['docs/burnish.1'])
      end
      if #code.text <= 28 then
        code.classes:insert('short')
        return code
      end
    end,
  }).content
  local description
  for at, block in ipairs(body) do
    if block.t == 'Para' and not description then
      description = utils.stringify(block)
    end
    if block.t == 'Header' then
      if block.level <= 3 then
        headings:insert(block:clone())
      end
      block.content:insert(pandoc.RawInline('html', '<a class="anchor" href="#' .. block.identifier .. '" aria-label="Link to this section">#</a>'))
      if block.attributes.kind then
        block.content:insert(pandoc.RawInline('html', '<span class="kind">' .. block.attributes.kind .. '</span>'))
        block.attributes.kind = nil
      end
    elseif block.t == 'Table' then
      local simple = utils.to_simple_table(block)
      body[at] = #simple.rows > 0 and picture_table(simple) or scrolling(block)
    elseif block.t == 'BulletList' or block.t == 'OrderedList' then
      body[at] = block:walk({ Table = scrolling })
    end
  end
  local meta = document.meta
  meta.pagetitle = words == 'burnish' and 'burnish: pictures of meshes without a GPU' or words .. ' · burnish'
  meta.heading = pandoc.MetaInlines(title.content)
  meta.description = description and description:sub(1, 300):gsub('%s+%S*$', '')
  meta.root = pandoc.MetaInlines({ pandoc.RawInline('html', root) })
  meta.version = os.getenv('SITE_VERSION')
  meta.nav = pandoc.MetaInlines({ pandoc.RawInline('html', links) })
  local listed = contents(headings)
  meta.contents = listed and pandoc.MetaInlines({ pandoc.RawInline('html', listed) })
  meta.class = source:match('^include/') and 'reference' or page == 'index.html' and 'front' or source:match('%.1$') and 'manual' or source:match('^source') and 'source' or nil
  meta.explorer = exists(os.getenv('SITE_EXPLORER')) and true or nil
  local file = assert(io.open(work .. '/files', 'a'))
  for _, line in ipairs(files) do
    file:write(line, '\n')
  end
  file:close()
  return pandoc.Pandoc(body, meta)
end
