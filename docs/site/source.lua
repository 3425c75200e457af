-- A reader for pandoc: a file of the repository as it is, under its name. SITE_PATH says which.

local languages = { c = 'c', h = 'c', cc = 'cpp', py = 'python', js = 'javascript', v = 'verilog', glsl = 'glsl', sh = 'bash' }

function Reader(input)
  local path = os.getenv('SITE_PATH')
  local language = languages[path:match('%.(%w+)$') or '']
  return pandoc.Pandoc({
    pandoc.Header(1, { pandoc.Code(path) }),
    pandoc.CodeBlock(tostring(input), pandoc.Attr('', language and { language } or {})),
  })
end
