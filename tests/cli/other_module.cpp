// A module as another version of limn would bring it.
extern "C" const char limn_module_id[] = "0.0.1";
extern "C" const int limn_module = 0;
