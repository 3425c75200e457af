# Writes OUTPUT, a C file with the files of the list SCRIPTS as strings: plot_scripts of program/plot/gnuplot.h.
set(texts "")
set(rows "")
foreach(script IN LISTS SCRIPTS)
  get_filename_component(name ${script} NAME_WE)
  string(MAKE_C_IDENTIFIER "text_${name}" text)
  file(READ ${script} bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND texts "static const char ${text}[] = {${bytes}0};\n")
  string(APPEND rows "    {\"${name}\", ${text}},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"plot/gnuplot.h\"\n${texts}"
  "const plot_script plot_scripts[] = {\n${rows}    {NULL, NULL},\n};\n")
