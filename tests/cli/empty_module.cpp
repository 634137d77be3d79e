// A module of this version of limn that has nothing for a program.
extern "C" const char limn_module_id[] = LIMN_MODULE_ID;
