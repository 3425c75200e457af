/* Completions of a shell. */
#ifndef TOOL_CLI_COMPLETE_H
#define TOOL_CLI_COMPLETE_H

/* Prints them on standard output, for "bash", "zsh" or "fish". */
void cli_print_completion(const char *shell);

#endif
