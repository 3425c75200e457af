/* The man page. */
#ifndef TOOL_CLI_MAN_H
#define TOOL_CLI_MAN_H

/* Prints it in roff on standard output. */
void cli_print_man(void);

#endif
