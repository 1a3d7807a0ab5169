/* The public header compiles alone, in every language that it promises; nothing is included before it. */
#include <ifsm.h>

static ifsm_model nothing;

int main(void) { return nothing.id == 0 ? 0 : 1; }
