// The OpenGL 4.5 core functions that Gnomon calls. Each context has a table of pointers to them.
#pragma once

#include <GL/glcorearb.h>

// The list of OpenGL functions, one line X(type, member, name) per function.
#define GNOMON_GL_FUNCTIONS(X)                                                                                         \
    X(PFNGLACTIVETEXTUREPROC, activeTexture, "glActiveTexture")                                                        \
    X(PFNGLATTACHSHADERPROC, attachShader, "glAttachShader")                                                           \
    X(PFNGLBEGINQUERYPROC, beginQuery, "glBeginQuery")                                                                 \
    X(PFNGLBINDBUFFERPROC, bindBuffer, "glBindBuffer")                                                                 \
    X(PFNGLBINDBUFFERRANGEPROC, bindBufferRange, "glBindBufferRange")                                                  \
    X(PFNGLBINDFRAMEBUFFERPROC, bindFramebuffer, "glBindFramebuffer")                                                  \
    X(PFNGLBINDSAMPLERPROC, bindSampler, "glBindSampler")                                                              \
    X(PFNGLBINDTEXTUREPROC, bindTexture, "glBindTexture")                                                              \
    X(PFNGLBINDTEXTUREUNITPROC, bindTextureUnit, "glBindTextureUnit")                                                  \
    X(PFNGLBINDVERTEXARRAYPROC, bindVertexArray, "glBindVertexArray")                                                  \
    X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, checkNamedFramebufferStatus, "glCheckNamedFramebufferStatus")              \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, clearNamedFramebufferfv, "glClearNamedFramebufferfv")                          \
    X(PFNGLCLIENTWAITSYNCPROC, clientWaitSync, "glClientWaitSync")                                                     \
    X(PFNGLCLIPCONTROLPROC, clipControl, "glClipControl")                                                              \
    X(PFNGLCOLORMASKPROC, colorMask, "glColorMask")                                                                    \
    X(PFNGLCOMPILESHADERPROC, compileShader, "glCompileShader")                                                        \
    X(PFNGLCOPYNAMEDBUFFERSUBDATAPROC, copyNamedBufferSubData, "glCopyNamedBufferSubData")                             \
    X(PFNGLCREATEBUFFERSPROC, createBuffers, "glCreateBuffers")                                                        \
    X(PFNGLCREATEFRAMEBUFFERSPROC, createFramebuffers, "glCreateFramebuffers")                                         \
    X(PFNGLCREATEPROGRAMPROC, createProgram, "glCreateProgram")                                                        \
    X(PFNGLCREATEQUERIESPROC, createQueries, "glCreateQueries")                                                        \
    X(PFNGLCREATESHADERPROC, createShader, "glCreateShader")                                                           \
    X(PFNGLCREATETEXTURESPROC, createTextures, "glCreateTextures")                                                     \
    X(PFNGLCREATEVERTEXARRAYSPROC, createVertexArrays, "glCreateVertexArrays")                                         \
    X(PFNGLDELETEBUFFERSPROC, deleteBuffers, "glDeleteBuffers")                                                        \
    X(PFNGLDELETEFRAMEBUFFERSPROC, deleteFramebuffers, "glDeleteFramebuffers")                                         \
    X(PFNGLDELETEPROGRAMPROC, deleteProgram, "glDeleteProgram")                                                        \
    X(PFNGLDELETEQUERIESPROC, deleteQueries, "glDeleteQueries")                                                        \
    X(PFNGLDELETESHADERPROC, deleteShader, "glDeleteShader")                                                           \
    X(PFNGLDELETESYNCPROC, deleteSync, "glDeleteSync")                                                                 \
    X(PFNGLDELETETEXTURESPROC, deleteTextures, "glDeleteTextures")                                                     \
    X(PFNGLDELETEVERTEXARRAYSPROC, deleteVertexArrays, "glDeleteVertexArrays")                                         \
    X(PFNGLDEPTHFUNCPROC, depthFunc, "glDepthFunc")                                                                    \
    X(PFNGLDEPTHMASKPROC, depthMask, "glDepthMask")                                                                    \
    X(PFNGLDISABLEPROC, disable, "glDisable")                                                                          \
    X(PFNGLDRAWARRAYSPROC, drawArrays, "glDrawArrays")                                                                 \
    X(PFNGLENABLEPROC, enable, "glEnable")                                                                             \
    X(PFNGLENABLEVERTEXARRAYATTRIBPROC, enableVertexArrayAttrib, "glEnableVertexArrayAttrib")                          \
    X(PFNGLENDQUERYPROC, endQuery, "glEndQuery")                                                                       \
    X(PFNGLFENCESYNCPROC, fenceSync, "glFenceSync")                                                                    \
    X(PFNGLFINISHPROC, finish, "glFinish")                                                                             \
    X(PFNGLGETERRORPROC, getError, "glGetError")                                                                       \
    X(PFNGLGETINTEGERVPROC, getIntegerv, "glGetIntegerv")                                                              \
    X(PFNGLGETPROGRAMINFOLOGPROC, getProgramInfoLog, "glGetProgramInfoLog")                                            \
    X(PFNGLGETPROGRAMIVPROC, getProgramiv, "glGetProgramiv")                                                           \
    X(PFNGLGETQUERYOBJECTIVPROC, getQueryObjectiv, "glGetQueryObjectiv")                                               \
    X(PFNGLGETQUERYOBJECTUI64VPROC, getQueryObjectui64v, "glGetQueryObjectui64v")                                      \
    X(PFNGLGETSHADERINFOLOGPROC, getShaderInfoLog, "glGetShaderInfoLog")                                               \
    X(PFNGLGETSHADERIVPROC, getShaderiv, "glGetShaderiv")                                                              \
    X(PFNGLGETSTRINGPROC, getString, "glGetString")                                                                    \
    X(PFNGLGETTEXTUREIMAGEPROC, getTextureImage, "glGetTextureImage")                                                  \
    X(PFNGLGETUNIFORMLOCATIONPROC, getUniformLocation, "glGetUniformLocation")                                         \
    X(PFNGLLINKPROGRAMPROC, linkProgram, "glLinkProgram")                                                              \
    X(PFNGLMAPNAMEDBUFFERRANGEPROC, mapNamedBufferRange, "glMapNamedBufferRange")                                      \
    X(PFNGLMULTIDRAWELEMENTSBASEVERTEXPROC, multiDrawElementsBaseVertex, "glMultiDrawElementsBaseVertex")              \
    X(PFNGLMULTIDRAWELEMENTSINDIRECTPROC, multiDrawElementsIndirect, "glMultiDrawElementsIndirect")                    \
    X(PFNGLNAMEDBUFFERDATAPROC, namedBufferData, "glNamedBufferData")                                                  \
    X(PFNGLNAMEDBUFFERSTORAGEPROC, namedBufferStorage, "glNamedBufferStorage")                                         \
    X(PFNGLNAMEDBUFFERSUBDATAPROC, namedBufferSubData, "glNamedBufferSubData")                                         \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, namedFramebufferDrawBuffers, "glNamedFramebufferDrawBuffers")              \
    X(PFNGLNAMEDFRAMEBUFFERPARAMETERIPROC, namedFramebufferParameteri, "glNamedFramebufferParameteri")                 \
    X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, namedFramebufferTexture, "glNamedFramebufferTexture")                          \
    X(PFNGLPIXELSTOREIPROC, pixelStorei, "glPixelStorei")                                                              \
    X(PFNGLPROGRAMUNIFORM1IPROC, programUniform1i, "glProgramUniform1i")                                               \
    X(PFNGLPROGRAMUNIFORM4FPROC, programUniform4f, "glProgramUniform4f")                                               \
    X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, programUniformMatrix4fv, "glProgramUniformMatrix4fv")                          \
    X(PFNGLQUERYCOUNTERPROC, queryCounter, "glQueryCounter")                                                           \
    X(PFNGLREADPIXELSPROC, readPixels, "glReadPixels")                                                                 \
    X(PFNGLSCISSORPROC, scissor, "glScissor")                                                                          \
    X(PFNGLSHADERSOURCEPROC, shaderSource, "glShaderSource")                                                           \
    X(PFNGLTEXIMAGE2DPROC, texImage2D, "glTexImage2D")                                                                 \
    X(PFNGLTEXTUREPARAMETERIPROC, textureParameteri, "glTextureParameteri")                                            \
    X(PFNGLTEXTURESTORAGE2DPROC, textureStorage2D, "glTextureStorage2D")                                               \
    X(PFNGLTEXTURESUBIMAGE2DPROC, textureSubImage2D, "glTextureSubImage2D")                                            \
    X(PFNGLUSEPROGRAMPROC, useProgram, "glUseProgram")                                                                 \
    X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, vertexArrayAttribBinding, "glVertexArrayAttribBinding")                       \
    X(PFNGLVERTEXARRAYATTRIBFORMATPROC, vertexArrayAttribFormat, "glVertexArrayAttribFormat")                          \
    X(PFNGLVERTEXARRAYATTRIBIFORMATPROC, vertexArrayAttribIFormat, "glVertexArrayAttribIFormat")                       \
    X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, vertexArrayElementBuffer, "glVertexArrayElementBuffer")                       \
    X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, vertexArrayVertexBuffer, "glVertexArrayVertexBuffer")                          \
    X(PFNGLVIEWPORTPROC, viewport, "glViewport")

namespace gnomon::gl {

/// Pointers to the OpenGL functions of one context. They are valid on the thread where this context is current.
struct Api {
#define GNOMON_GL_MEMBER(type, member, name) type member = nullptr;
    GNOMON_GL_FUNCTIONS(GNOMON_GL_MEMBER)
#undef GNOMON_GL_MEMBER
};

using FunctionPointer = void (*)();
using FunctionSource = FunctionPointer (*)(const char* name);

/// Loads all OpenGL functions from `source`. Throws gnomon::Error with the name of the first missing function.
Api loadApi(FunctionSource source);

} // namespace gnomon::gl
