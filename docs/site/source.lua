-- A pandoc reader that shows the source file SITE_PATH under its name.

local languages = { c = 'c', h = 'c', cc = 'cpp', py = 'python', js = 'javascript', v = 'verilog', glsl = 'glsl', sh = 'bash' }

function Reader(input)
  local path = os.getenv('SITE_PATH')
  local language = languages[path:match('%.(%w+)$') or '']
  return pandoc.Pandoc({
    pandoc.Header(1, { pandoc.Code(path) }),
    pandoc.CodeBlock(tostring(input), pandoc.Attr('', language and { language } or {})),
  })
end
