/* Direct3D 9, a part of runner.c. It assembles token streams, because the system has no assembler. */
#define COBJMACROS
#include <d3d9.h>

static IDirect3DDevice9 *device;

/* The token stream of a program. Constants are set from outside, so that no driver computes with them beforehand. */
static void assemble(const Program *program, DWORD *token) {
    static const struct {
        const char *name;
        DWORD code;
    } codes[] = {{"mov", 1},     {"add", 2},     {"sub", 3},           {"mad", 4},         {"mul", 5},
                 {"rcp", 6},     {"dp3", 8},     {"dp4", 9},           {"lrp", 18},        {"dcl", 31},
                 {"dcl_2d", 31}, {"texcrd", 64}, {"dcl_position", 31}, {"dcl_color0", 31}, {"texkill", 65},
                 {"tex", 66},    {"texld", 66},  {"texdepth", 87},     {"phase", 0xfffd}};
    static const char kinds[] = "rvctPD..Cos"; /* indexed by type; s is 10, the depth (o) is not used */
    *token++ = (program->vertex ? 0xfffe0000u : 0xffff0000u) | (DWORD)program->major << 8 | (DWORD)program->minor;
    for (const Step *step = program->step; step < program->step + program->count; step++) {
        DWORD *first = token++, code = 0;
        for (size_t i = 0; i < sizeof codes / sizeof *codes; i++)
            if (!strcmp(codes[i].name, step->name)) code = codes[i].code;
        *first = code | (step->together ? 1u << 30 : 0);
        if (code == 0xfffd) continue;
        if (code == 31)
            *token++ = !strcmp(step->name, "dcl_2d")       ? 0x90000000u
                       : !strcmp(step->name, "dcl_color0") ? 0x8000000au
                                                           : 1u << 31;
        for (int i = -1; i < step->sources; i++) {
            const Operand *operand = i < 0 ? &step->to : &step->from[i];
            DWORD type = (DWORD)(strchr(kinds, operand->kind) - kinds), swizzle = 0;
            for (int c = 0; c < 4; c++) swizzle |= (DWORD)operand->swizzle[c] << (16 + 2 * c);
            *token = 1u << 31 | (type & 7) << 28 | (type & 24) << 8 | (DWORD)operand->number;
            if (i < 0)
                *token++ |= (DWORD)step->mask << 16 | (DWORD)step->saturated << 20 | ((DWORD)step->shift & 15) << 24;
            else *token++ |= swizzle | (operand->negated ? 1u << 24 : 0);
        }
        if (program->major > 1) *first |= (DWORD)(token - first - 1) << 24;
    }
    *token = 0xffff;
}

static void open_card(void) {
    HMODULE library = LoadLibraryA("d3d9.dll");
    IDirect3D9 *(WINAPI * create)(UINT) = NULL;
    IDirect3D9 *interface9;
    D3DADAPTER_IDENTIFIER9 card;
    D3DPRESENT_PARAMETERS present;
    HWND window = CreateWindowA("STATIC", "runner", WS_OVERLAPPEDWINDOW, 0, 0, 64, 64, NULL, NULL, NULL, NULL);
    if (library) *(FARPROC *)&create = GetProcAddress(library, "Direct3DCreate9");
    if (!create || !(interface9 = create(D3D_SDK_VERSION))) die("this system has no Direct3D 9 (d3d9.dll)");
    memset(&present, 0, sizeof present);
    present.Windowed = TRUE;
    present.SwapEffect = D3DSWAPEFFECT_DISCARD;
    present.hDeviceWindow = window;
    HRESULT result = E_FAIL;
    /* For a card without vertex programs, the processor runs them. */
    for (int hardware = 1; hardware >= 0 && FAILED(result); hardware--)
        result = IDirect3D9_CreateDevice(interface9, 0, D3DDEVTYPE_HAL, window,
                                         D3DCREATE_FPU_PRESERVE | (hardware ? D3DCREATE_HARDWARE_VERTEXPROCESSING
                                                                            : D3DCREATE_SOFTWARE_VERTEXPROCESSING),
                                         &present, &device);
    if (FAILED(result))
        die("Direct3D 9 gives no device (error %08lx): is there a display and a driver?", (unsigned long)result);
    IDirect3D9_GetAdapterIdentifier(interface9, 0, 0, &card);
    put("# card: %s (vendor %04lx, device %04lx)\n# driver: %s %u.%u.%u.%u\n# interface: Direct3D 9\n",
        card.Description, card.VendorId, card.DeviceId, card.Driver, HIWORD(card.DriverVersion.HighPart),
        LOWORD(card.DriverVersion.HighPart), HIWORD(card.DriverVersion.LowPart), LOWORD(card.DriverVersion.LowPart));
}

/* vs_1_1: declares v0 to v4 as position, two colors and two coordinates, and moves each to its output. It
 * passes colors to the card as floats. */
static const DWORD through[] = {0xfffe0101, 31, 0x80000000, 0x900f0000, 31,    0x8000000a, 0x900f0001, 31, 0x8001000a,
                                0x900f0002, 31, 0x80000005, 0x900f0003, 31,    0x80010005, 0x900f0004, 1,  0xc00f0000,
                                0x90e40000, 1,  0xd00f0000, 0x90e40001, 1,     0xd00f0001, 0x90e40002, 1,  0xe00f0000,
                                0x90e40003, 1,  0xe00f0001, 0x90e40004, 0xffff};
static const D3DVERTEXELEMENT9 elements[] = {
    {0, 0, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_POSITION, 0},  {0, 16, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_COLOR, 0},
    {0, 32, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_COLOR, 1},    {0, 48, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_TEXCOORD, 0},
    {0, 64, D3DDECLTYPE_FLOAT4, 0, D3DDECLUSAGE_TEXCOORD, 1}, D3DDECL_END()};

/* Makes the texture of a probe. `rgba8` is made as `bgra8`, which all cards have, with the same channels. */
static int make_texture(const Probe *probe, IDirect3DTexture9 **texture) {
    int narrow = !strcmp(probe->format, "bgr565"), is_signed = !strcmp(probe->format, "rgba8s");
    D3DLOCKED_RECT locked;
    DWORD border = 0;
    float bias = (float)probe->bias;
    if (FAILED(IDirect3DDevice9_CreateTexture(device, (UINT)probe->texels[0], (UINT)probe->texels[1],
                                              probe->automatic ? 0 : 1, probe->automatic ? D3DUSAGE_AUTOGENMIPMAP : 0,
                                              narrow      ? D3DFMT_R5G6B5
                                              : is_signed ? D3DFMT_Q8W8V8U8
                                                          : D3DFMT_A8R8G8B8,
                                              D3DPOOL_MANAGED, texture, NULL)))
        return refuse("the driver has no texture of %s%s", probe->format,
                      probe->automatic ? " that makes its mipmaps" : "");
    if (FAILED(IDirect3DTexture9_LockRect(*texture, 0, &locked, NULL, 0)))
        return refuse("the texture cannot be written");
    for (int y = 0; y < probe->texels[1]; y++)
        for (int x = 0; x < probe->texels[0]; x++) {
            char *row = (char *)locked.pBits + y * locked.Pitch;
            unsigned code =
                pack(probe->texel[y * probe->texels[0] + x], narrow, is_signed ? 0 : 16, is_signed ? 16 : 0);
            if (narrow) ((unsigned short *)row)[x] = (unsigned short)code;
            else ((unsigned *)row)[x] = code;
        }
    IDirect3DTexture9_UnlockRect(*texture, 0);
    if (probe->automatic) IDirect3DTexture9_GenerateMipSubLevels(*texture);
    for (int i = 0; i < 4; i++) border |= (DWORD)((float)probe->border[i] * 255 + 0.5f) << (i == 3 ? 24 : 16 - 8 * i);
    DWORD state[][2] = {{D3DSAMP_BORDERCOLOR, border},
                        {D3DSAMP_ADDRESSU, *probe->address ? D3DTADDRESS_BORDER : D3DTADDRESS_CLAMP},
                        {D3DSAMP_ADDRESSV, *probe->address ? D3DTADDRESS_BORDER : D3DTADDRESS_CLAMP},
                        {D3DSAMP_MINFILTER, probe->linear ? D3DTEXF_LINEAR : D3DTEXF_POINT},
                        {D3DSAMP_MAGFILTER, probe->linear ? D3DTEXF_LINEAR : D3DTEXF_POINT},
                        {D3DSAMP_MIPFILTER, !*probe->mip         ? D3DTEXF_NONE
                                            : *probe->mip == 'l' ? D3DTEXF_LINEAR
                                                                 : D3DTEXF_POINT},
                        {D3DSAMP_MIPMAPLODBIAS, 0}};
    memcpy(&state[6][1], &bias, sizeof bias);
    for (int i = 0; i < 7; i++)
        IDirect3DDevice9_SetSamplerState(device, 0, (D3DSAMPLERSTATETYPE)state[i][0], state[i][1]);
    IDirect3DDevice9_SetTexture(device, 0, (IDirect3DBaseTexture9 *)*texture);
    return 1;
}

/* Objects that a draw creates, and releases however it ends. */
typedef struct {
    IDirect3DPixelShader9 *pixel;
    IDirect3DVertexShader9 *vertex;
    IDirect3DVertexDeclaration9 *declaration;
    IDirect3DTexture9 *texture;
    IDirect3DSurface9 *target, *copy, *depth;
} Made;

static int draw_with(const Probe *probe, Image *image, Made *made) {
    const UINT width = (UINT)probe->size[0], height = (UINT)probe->size[1];
    DWORD pixel[512], vertex[512];
    D3DLOCKED_RECT locked;
    assemble(&probe->pixel, pixel);
    assemble(&probe->vertex, vertex);
    if (FAILED(IDirect3DDevice9_CreatePixelShader(device, pixel, &made->pixel)))
        return refuse("the driver refuses the ps_%d_%d program", probe->pixel.major, probe->pixel.minor);
    if (FAILED(IDirect3DDevice9_CreateVertexShader(device, probe->vertex.count ? vertex : through, &made->vertex)) ||
        FAILED(IDirect3DDevice9_CreateVertexDeclaration(device, elements, &made->declaration)))
        return refuse("the driver refuses the vs_1_1 program");
    if (FAILED(IDirect3DDevice9_CreateRenderTarget(device, width, height, D3DFMT_A8R8G8B8, D3DMULTISAMPLE_NONE, 0,
                                                   FALSE, &made->target, NULL)) ||
        FAILED(IDirect3DDevice9_CreateOffscreenPlainSurface(device, width, height, D3DFMT_A8R8G8B8, D3DPOOL_SYSTEMMEM,
                                                            &made->copy, NULL)))
        return refuse("the driver has no target of bgra8");
    if (probe->depth &&
        FAILED(IDirect3DDevice9_CreateDepthStencilSurface(device, width, height, D3DFMT_D16_LOCKABLE,
                                                          D3DMULTISAMPLE_NONE, 0, FALSE, &made->depth, NULL)))
        return refuse("the driver has no depth buffer of 16 bits that can be read (D3DFMT_D16_LOCKABLE)");
    if (probe->textured && !make_texture(probe, &made->texture)) return 0;
    IDirect3DDevice9_SetPixelShader(device, made->pixel);
    IDirect3DDevice9_SetVertexShader(device, made->vertex);
    IDirect3DDevice9_SetVertexDeclaration(device, made->declaration);
    for (UINT i = 0; i < 8; i++) {
        if (probe->pixel.set[i]) IDirect3DDevice9_SetPixelShaderConstantF(device, i, probe->pixel.constant[i], 1);
        if (probe->vertex.set[i]) IDirect3DDevice9_SetVertexShaderConstantF(device, i, probe->vertex.constant[i], 1);
    }
    IDirect3DDevice9_SetRenderTarget(device, 0, made->target);
    IDirect3DDevice9_SetDepthStencilSurface(device, made->depth);
    const DWORD states[][2] = {
        {D3DRS_CULLMODE, D3DCULL_NONE},  {D3DRS_DITHERENABLE, FALSE},
        {D3DRS_ZFUNC, D3DCMP_LESSEQUAL}, {D3DRS_ZENABLE, probe->depth ? D3DZB_TRUE : D3DZB_FALSE},
        {D3DRS_ZWRITEENABLE, TRUE},      {D3DRS_FOGENABLE, FALSE}};
    for (size_t i = 0; i < sizeof states / sizeof *states; i++)
        IDirect3DDevice9_SetRenderState(device, (D3DRENDERSTATETYPE)states[i][0], states[i][1]);
    IDirect3DDevice9_Clear(device, 0, NULL, D3DCLEAR_TARGET | (probe->depth ? D3DCLEAR_ZBUFFER : 0), 0, 1, 0);
    IDirect3DDevice9_BeginScene(device);
    HRESULT drawn = IDirect3DDevice9_DrawPrimitiveUP(
        device, probe->strips == 4 ? D3DPT_TRIANGLEFAN : D3DPT_TRIANGLELIST,
        probe->strips == 4 ? 2 : (UINT)probe->corners / 3, probe->corner, sizeof probe->corner[0]);
    IDirect3DDevice9_EndScene(device);
    if (FAILED(drawn)) return refuse("the driver refuses to draw it");
    if (FAILED(IDirect3DDevice9_GetRenderTargetData(device, made->target, made->copy)) ||
        FAILED(IDirect3DSurface9_LockRect(made->copy, &locked, NULL, D3DLOCK_READONLY)))
        return refuse("the target cannot be read");
    for (UINT y = 0; y < height; y++)
        for (UINT x = 0; x < width; x++)
            for (UINT c = 0; c < 4; c++)
                image->color[y][x][c] =
                    ((unsigned char *)locked.pBits)[y * (UINT)locked.Pitch + 4 * x + (c == 3 ? 3u : 2u - c)];
    IDirect3DSurface9_UnlockRect(made->copy);
    if (!probe->depth) return 1;
    if (FAILED(IDirect3DSurface9_LockRect(made->depth, &locked, NULL, D3DLOCK_READONLY)))
        return refuse("the depth buffer cannot be read");
    for (UINT y = 0; y < height; y++)
        for (UINT x = 0; x < width; x++)
            image->depth[y][x] = ((unsigned short *)((char *)locked.pBits + y * (UINT)locked.Pitch))[x];
    IDirect3DSurface9_UnlockRect(made->depth);
    return 1;
}

static int draw(const Probe *probe, Image *image) {
    Made made = {0};
    IDirect3DSurface9 *screen = NULL;
    IDirect3DDevice9_GetRenderTarget(device, 0, &screen);
    int drawn = draw_with(probe, image, &made);
    IDirect3DDevice9_SetRenderTarget(device, 0, screen);
    IDirect3DDevice9_SetDepthStencilSurface(device, NULL);
    IDirect3DDevice9_SetTexture(device, 0, NULL);
    IDirect3DDevice9_SetPixelShader(device, NULL);
    IDirect3DDevice9_SetVertexShader(device, NULL);
    IUnknown *all[] = {(IUnknown *)made.pixel,   (IUnknown *)made.vertex, (IUnknown *)made.declaration,
                       (IUnknown *)made.texture, (IUnknown *)made.target, (IUnknown *)made.copy,
                       (IUnknown *)made.depth,   (IUnknown *)screen};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i]) IUnknown_Release(all[i]);
    return drawn;
}
