/* `burnish serve-stdio`: its flags. */
#include "serve/serve.h"
#include "render/flags.h"
#include "render/render.h"

#include <string.h>
#include <unistd.h>

#include "cli/limits.h"
#include "cli/main.h"
#include "sandbox/lock.h"

static cli_work serve_all;

#define TARGET(member) .offset = offsetof(serve_settings, member)

static const cli_flag flags[] = {
    {.group = "Server",
     .topic = "server",
     CLI_FLAG("jobs", "N", "pictures at a time", cli_flag_integer, jobs),
     CLI_RANGE(0, 1024),
     .default_text = "0",
     .default_label = "all cores",
     .letter = 'j',
     .common = 1,
     .aliases = "workers,parallel",
     .manual = "How many requests are drawn at a time; 0 for as many as there are processors. The "
               "server keeps as many idle processes. Replies are written as they are finished: "
               "with *--jobs=1* in the order of the requests."},
    {CLI_FLAG("threads", "N", "threads per picture", cli_flag_integer, render.job.threads),
     CLI_RANGE(1, 1024), .default_text = "1", .common = 1,
     .manual = "Threads that draw one picture. More threads shorten a single request, but not many "
               "at a time."},
    {CLI_FLAG("max-request-bytes", "N", "refuse larger requests", cli_flag_bytes,
              max_request_bytes),
     CLI_RANGE(1, 4294967295.0), .default_text = "256M", .common = 1,
     .manual = "A larger request, including its files, is skipped; the reply has code 5. _N_ may "
               "end in *K*, *M* or *G*."},
    {CLI_FLAG("max-seconds", "N", "time limit per request", cli_flag_real, render.job.max_seconds),
     CLI_RANGE(0, 1e6), .default_text = "60", .common = 1,
     .manual = "The reply to a request that takes more processor time, or ten times that in "
               "wall-clock time from its last byte on, has code 5. 0: no limit."},
    {CLI_FLAG("max-memory", "N", "memory limit per request, such as 500M", cli_flag_bytes,
              render.job.max_memory),
     CLI_RANGE(1, 9e18), .default_text = "2G", .common = 1,
     .manual = "The reply to a request that needs more memory, or whose reply is larger, has code "
               "6. docs/serve.md has the total. _N_ may end in *K*, *M* or *G*."},
    {CLI_SWITCH("no-sandbox", "workers may open files", no_sandbox),
     .manual = "Each request is parsed and drawn in a process of its own that can't open files or "
               "sockets or start programs (docs/security.md). Without libseccomp or support by the "
               "kernel, the server does not start. With this flag it starts, and processes are not "
               "sandboxed."},
    {.group = "Picture",
     .topic = "picture",
     CLI_FLAG("size", "WxH", "width and height in pixels; N: a square", cli_flag_size,
              render.picture.size),
     CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE),
     .letter = 's',
     .default_text = "512x512",
     .common = 1,
     .also = "resolution",
     .aliases = "width,height,res",
     .manual = "Default width and height of pictures."},
};

static const cli_example examples[] = {
    {"burnish serve-stdio --size=256 <requests >replies", "thumbnails"},
    {NULL, NULL},
};

static const cli_term request_terms[] = {
    {"*name*", "the mesh's name, which selects the format by its extension and begins messages; "
               "without bytes, a built-in object such as *:teapot*"},
    {"*flags*", "an array of strings: flags of *burnish render* for camera, light, surface, input "
                "and picture, such as *--size=256*; they follow those of the command line"},
    {"*files*", "an array of {\"name\", \"bytes\"}: referenced files; they are the last bytes of "
                "the frame, in this order"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "REQUESTS OF A SERVER",
     .text = "A request is a frame: length and id, 4 bytes each and little-endian, then `length` "
             "bytes: a JSON object in one line, a newline, the bytes of the mesh. The reply has "
             "the same id and form: a JSON object in one line, a newline, the bytes of the "
             "picture. On success *code* is 0, and *report* is the output of *burnish render "
             "--json*. Otherwise *code* is the exit code of *burnish render*, and *error* its "
             "message. Keys of a request, all optional:",
     .terms = request_terms,
     .closing = "An invalid frame, such as text, ends the server with exit code 4. docs/serve.md "
                "has clients, and an example behind a web server."},
    {.heading = NULL},
};

const cli_command serve_command = {
    .name = "serve-stdio",
    .operand = "",
    .summary = "draw pictures on request, through pipes",
    .operand_help = "requests on standard input, replies on standard output",
    .manual =
        "Reads requests from standard input and writes pictures to standard output until its input "
        "ends. A web server or another program starts it once to draw many meshes. Pictures are "
        "identical to those of *burnish render*. Each process starts, allocates memory and enters "
        "the sandbox before its request arrives; it serves one request and is replaced. No request "
        "can see another, and a request that crashes or exceeds a limit gets an error reply.\n"
        "Flags of *burnish render* given here apply to every request; a request can override them, "
        "except for limits.",
    .operands_max = 0,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW | CLI_PHASE_FILE,
    .heir = HEIR_SERVE,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(serve_settings),
    .work = serve_all,
};

const cli_command serve_request_command = {
    .name = "serve-stdio",
    .operand = "",
    .operands_max = 0,
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW | CLI_PHASE_FILE,
    .heir = HEIR_REQUEST,
    .settings_size = sizeof(render_settings),
};

#ifdef _WIN32

static burnish_status serve_all(void *from, cli_call *call, burnish_error *error) {
    (void)from, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "serve-stdio: not supported on this system; run burnish render for each input");
}

#else

static burnish_status serve_all(void *from, cli_call *call, burnish_error *error) {
    serve_settings *settings = from;
    (void)call;
    render_settings defaults = settings->render;
    defaults.input.name = ":sphere";
    defaults.output.path = "-";
    if (isatty(STDIN_FILENO) || isatty(STDOUT_FILENO)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "serve-stdio: standard %s is a terminal, but requests and replies are "
                        "binary: see docs/serve.md",
                        isatty(STDIN_FILENO) ? "input" : "output");
    }
    if (!settings->no_sandbox && !sandbox_is_built()) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "serve-stdio: this program was built without libseccomp; install "
                        "libseccomp-dev and build again, or use --no-sandbox");
    }
    defaults.given = (cli_given){{0}}; /* requests may set them again */
    const burnish_status status = render_finish(&defaults, error);
    if (status == BURNISH_STATUS_OK && !settings->no_sandbox) {
        sandbox_prepare(0); /* if it fails, workers report it */
    }
    cli_prepare_forks();
    return status == BURNISH_STATUS_OK ? serve_run(settings, error) : status;
}

#endif
