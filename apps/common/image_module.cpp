// The module with the image codec that uses OpenImageIO: see image_loader.cpp.
#include "io/image_codec.h"
#include "module.h"

extern "C" const char limn_module_id[] = LIMN_MODULE_ID;

extern "C" const limn::ImageCodec limn_module{limn::can_encode, limn::encode, limn::decode, limn::decode_header};
